#include "load/mesh/common/weld.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "base/parallel_for.hpp"
#include "geometry/normal.hpp"

namespace pah {
namespace {

// Adding 0 makes 0 and -0 equal.
std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); }

std::uint64_t mix(std::uint64_t hash, std::uint64_t bits) {
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32);
}

std::uint64_t mix(std::uint64_t hash, const Vec3& v) {
  return mix(mix(hash, bits_of(v.x) | std::uint64_t{bits_of(v.y)} << 32), bits_of(v.z));
}

std::uint64_t mix(std::uint64_t hash, const Vec2& v) {
  return mix(hash, bits_of(v.x) | std::uint64_t{bits_of(v.y)} << 32);
}

std::uint64_t hash_of(const VertexValues& v) {
  return mix(mix(mix(mix(0, v.position), v.normal), v.uv), v.color);
}

bool equal(const VertexValues& a, const VertexValues& b) {
  return a.position == b.position && a.normal == b.normal && a.uv == b.uv && a.color == b.color;
}

// A vertex with a part of its hash. Comparing hashes first avoids most comparisons of vertices.
struct HashedVertex {
  std::uint32_t hash;
  std::uint32_t vertex;
};

// Vertices grouped by some bits of their hashes, so that the table of a group fits the cache.
// Vertices of a group keep their order.
class HashGroups {
 public:
  HashGroups(std::uint32_t count, const std::function<VertexValues(std::uint32_t)>& values)
      : shift_(32 - static_cast<int>(std::bit_width(std::min(count / 4096, 1023U)))),
        groups_(std::size_t{1} << (32 - shift_)),
        members_(count) {
    const std::size_t chunks = (std::size_t{count} + chunk - 1) / chunk;
    std::vector<std::uint32_t> places(chunks *
                                      groups_);  // of the first member of a group in a chunk
    const auto for_each = [&](std::size_t c, const auto& visit) {
      for (std::size_t i = c * chunk; i < std::min<std::size_t>(count, (c + 1) * chunk); ++i) {
        const auto vertex = static_cast<std::uint32_t>(i);
        const auto hash = static_cast<std::uint32_t>(hash_of(values(vertex)));
        visit(places[c * groups_ + group_of(hash)], HashedVertex{hash, vertex});
      }
    };
    parallel_for(chunks, 1, [&](std::size_t c) {
      for_each(c, [](std::uint32_t& number, const HashedVertex&) { ++number; });
    });
    std::uint32_t sum = 0;
    for (std::size_t group = 0; group < groups_; ++group) {
      begins_.push_back(sum);
      for (std::size_t c = 0; c < chunks; ++c)
        sum += std::exchange(places[c * groups_ + group], sum);
    }
    begins_.push_back(sum);
    parallel_for(chunks, 1, [&](std::size_t c) {
      for_each(
          c, [&](std::uint32_t& place, const HashedVertex& member) { members_[place++] = member; });
    });
  }

  [[nodiscard]] std::size_t count() const { return groups_; }
  [[nodiscard]] std::span<const HashedVertex> members(std::size_t group) const {
    return {members_.data() + begins_[group], begins_[group + 1] - begins_[group]};
  }

 private:
  static constexpr std::size_t chunk = 1U << 15;

  [[nodiscard]] std::size_t group_of(std::uint32_t hash) const {
    return static_cast<std::size_t>(std::uint64_t{hash} >> shift_);
  }

  int shift_;
  std::size_t groups_;
  std::vector<HashedVertex> members_;
  std::vector<std::uint32_t> begins_;
};

}  // namespace

std::vector<std::uint32_t> first_equal_vertices(
    std::uint32_t count, const std::function<VertexValues(std::uint32_t)>& values) {
  std::vector<std::uint32_t> first(count);
  const HashGroups groups(count, values);
  parallel_for(groups.count(), 4, [&](std::size_t group) {
    const std::span<const HashedVertex> members = groups.members(group);
    const std::size_t mask = std::bit_ceil(2 * members.size() + 1) - 1;
    std::vector<HashedVertex> table(mask + 1, {0, count});  // `count` marks an empty slot
    for (const HashedVertex& member : members) {
      std::size_t slot = member.hash & mask;
      while (table[slot].vertex != count &&
             !(table[slot].hash == member.hash &&
               equal(values(table[slot].vertex), values(member.vertex))))
        slot = (slot + 1) & mask;
      if (table[slot].vertex == count) table[slot] = member;
      first[member.vertex] = table[slot].vertex;
    }
  });
  return first;
}

MeshBuilder::MeshBuilder(const VertexParts& parts, std::size_t expected_triangles,
                         std::size_t expected_vertices)
    : parts_(parts), expected_triangles_(expected_triangles) {
  mesh_.triangles.reserve(expected_triangles);
  mesh_.positions.reserve(expected_vertices);
  if (parts.normals) mesh_.normals.reserve(expected_vertices);
  if (parts.uvs) mesh_.uvs.reserve(expected_vertices);
  if (parts.colors) mesh_.colors.reserve(expected_vertices);
}

std::uint64_t MeshBuilder::hash(std::uint32_t vertex) const {
  std::uint64_t h = mix(0, mesh_.positions[vertex]);
  if (parts_.normals) h = mix(h, mesh_.normals[vertex]);
  if (parts_.uvs) h = mix(h, mesh_.uvs[vertex]);
  if (parts_.colors) h = mix(h, mesh_.colors[vertex]);
  return h;
}

bool MeshBuilder::same(std::uint32_t a, std::uint32_t b) const {
  return mesh_.positions[a] == mesh_.positions[b] &&
         (!parts_.normals || mesh_.normals[a] == mesh_.normals[b]) &&
         (!parts_.uvs || mesh_.uvs[a] == mesh_.uvs[b]) &&
         (!parts_.colors || mesh_.colors[a] == mesh_.colors[b]);
}

std::uint32_t MeshBuilder::add_new_vertex(const VertexValues& values) {
  const auto vertex = static_cast<std::uint32_t>(vertices());
  mesh_.positions.push_back(values.position);
  if (parts_.normals) mesh_.normals.push_back(values.normal);
  if (parts_.uvs) mesh_.uvs.push_back(values.uv);
  if (parts_.colors) mesh_.colors.push_back(values.color);
  return vertex;
}

std::uint32_t MeshBuilder::add_vertex(const VertexValues& values) {
  if (2 * (vertices() + 1) > table_.size()) grow();
  // Adds the vertex first, and removes it again if an equal one exists.
  const std::uint32_t vertex = add_new_vertex(values);
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
  // A closed mesh has half as many vertices as triangles.
  const std::size_t first_size = std::bit_ceil(expected_triangles_ + 16);
  table_.assign(table_.empty() ? first_size : 2 * table_.size(), 0);
  const std::size_t mask = table_.size() - 1;
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
  for (const Vec3& p : mesh.positions) point_of_vertex.push_back(by_position.add_vertex({p}));

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
    // The sum is 0 if all triangles are degenerate or cancel. Then any direction will do.
    mesh.normals[i] = length > 0 ? Vec3(sum / length) : Vec3(0, 1, 0);
  }
}

}  // namespace pah
