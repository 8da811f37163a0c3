#include "io/mesh/weld.hpp"

#include <bit>
#include <cmath>
#include <utility>

#include "geometry/normal.hpp"

namespace pah {
namespace {

// 0 and -0 are one position.
std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); }

std::uint64_t mix(std::uint64_t hash, std::uint64_t bits) {
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32);
}

std::uint64_t mix(std::uint64_t hash, const Vec3& v) {
  return mix(mix(hash, bits_of(v.x) | std::uint64_t{bits_of(v.y)} << 32), bits_of(v.z));
}

}  // namespace

MeshBuilder::MeshBuilder(const VertexParts& parts, std::size_t expected_triangles,
                         std::size_t expected_vertices)
    : parts_(parts) {
  mesh_.triangles.reserve(expected_triangles);
  mesh_.positions.reserve(expected_vertices);
  if (parts.normals) mesh_.normals.reserve(expected_vertices);
  if (parts.uvs) mesh_.uvs.reserve(expected_vertices);
  if (parts.colors) mesh_.colors.reserve(expected_vertices);
  // A closed mesh has half as many vertices as triangles.
  table_.resize(std::bit_ceil(expected_triangles + 16));
}

std::uint64_t MeshBuilder::hash(std::uint32_t vertex) const {
  std::uint64_t h = mix(0, mesh_.positions[vertex]);
  if (parts_.normals) h = mix(h, mesh_.normals[vertex]);
  if (parts_.uvs) {
    const Vec2& uv = mesh_.uvs[vertex];
    h = mix(h, bits_of(uv.x) | std::uint64_t{bits_of(uv.y)} << 32);
  }
  if (parts_.colors) h = mix(h, mesh_.colors[vertex]);
  return h;
}

bool MeshBuilder::same(std::uint32_t a, std::uint32_t b) const {
  return mesh_.positions[a] == mesh_.positions[b] &&
         (!parts_.normals || mesh_.normals[a] == mesh_.normals[b]) &&
         (!parts_.uvs || mesh_.uvs[a] == mesh_.uvs[b]) &&
         (!parts_.colors || mesh_.colors[a] == mesh_.colors[b]);
}

std::uint32_t MeshBuilder::add_vertex(const Vec3& position, const Vec3& normal, const Vec2& uv,
                                      const Vec3& color) {
  if (2 * (vertices() + 1) > table_.size()) grow();
  // Added first, taken back if it is there already.
  const auto vertex = static_cast<std::uint32_t>(vertices());
  mesh_.positions.push_back(position);
  if (parts_.normals) mesh_.normals.push_back(normal);
  if (parts_.uvs) mesh_.uvs.push_back(uv);
  if (parts_.colors) mesh_.colors.push_back(color);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = hash(vertex) & mask;; slot = (slot + 1) & mask) {
    if (table_[slot] == 0) {
      table_[slot] = vertex + 1;
      return vertex;
    }
    const std::uint32_t found = table_[slot] - 1;
    if (!same(found, vertex)) continue;
    mesh_.positions.pop_back();
    if (parts_.normals) mesh_.normals.pop_back();
    if (parts_.uvs) mesh_.uvs.pop_back();
    if (parts_.colors) mesh_.colors.pop_back();
    return found;
  }
}

void MeshBuilder::grow() {
  const std::size_t mask = 2 * table_.size() - 1;
  table_.assign(mask + 1, 0);
  for (std::uint32_t vertex = 0; vertex < vertices(); ++vertex) {
    std::size_t slot = hash(vertex) & mask;
    while (table_[slot] != 0) slot = (slot + 1) & mask;
    table_[slot] = vertex + 1;
  }
}

Mesh MeshBuilder::take() {
  table_ = {};
  mesh_.positions.shrink_to_fit();
  mesh_.normals.shrink_to_fit();
  mesh_.uvs.shrink_to_fit();
  mesh_.colors.shrink_to_fit();
  mesh_.triangles.shrink_to_fit();
  return std::move(mesh_);
}

void smooth_normals(Mesh& mesh) {
  MeshBuilder by_position({}, mesh.triangles.size());
  std::vector<std::uint32_t> point_of_vertex;
  point_of_vertex.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) point_of_vertex.push_back(by_position.add_vertex(p, {}, {}));

  std::vector<DVec3> sums(by_position.vertices(), DVec3{0});
  for (const UVec3& t : mesh.triangles) {
    const DVec3 corners[3] = {DVec3(mesh.positions[t.x]), DVec3(mesh.positions[t.y]),
                              DVec3(mesh.positions[t.z])};
    const DVec3 normal = scaled_normal(corners[0], corners[1], corners[2]);
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const DVec3 a = corners[(k + 1) % 3] - corners[k];
      const DVec3 b = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(length, glm::dot(a, b));
      sums[point_of_vertex[t[k]]] += angle / length * normal;
    }
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const DVec3& sum = sums[point_of_vertex[i]];
    const double length = glm::length(sum);
    // Where all triangles are without area or cancel, any direction is as good.
    mesh.normals[i] = length > 0 ? Vec3(sum / length) : Vec3(0, 1, 0);
  }
}

}  // namespace pah
