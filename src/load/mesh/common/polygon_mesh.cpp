#include "load/mesh/common/polygon_mesh.hpp"

#include <algorithm>
#include <span>

#include "base/parallel_for.hpp"
#include "geometry/normal.hpp"
#include "load/mesh/common/polygon.hpp"
#include "load/mesh/common/weld.hpp"

namespace pah {
namespace {

using Run = PolygonMesh::Run;

// A run of faces with its end and its first corner.
struct Faces {
  std::uint32_t material;
  std::size_t first;
  std::size_t last;  // one past the end
  std::size_t first_corner;
};

// Groups the runs by material, in the order of the file.
std::vector<Faces> faces_by_material(const PolygonMesh& polygons, bool merged) {
  const std::size_t count = polygons.faces();
  std::vector<Run> runs = polygons.runs;
  if (merged || runs.empty() || runs.front().first_face > 0) runs.insert(runs.begin(), {0, 0});
  if (merged) runs.resize(1);
  std::vector<Faces> result;
  std::size_t corner = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t last = i + 1 < runs.size() ? runs[i + 1].first_face : count;
    result.push_back({runs[i].material, runs[i].first_face, last, corner});
    for (std::size_t face = runs[i].first_face; face < last; ++face)
      corner += polygons.face_size(face);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Faces& a, const Faces& b) { return a.material < b.material; });
  return result;
}

// Makes one mesh for each material.
class TriangleMaker {
 public:
  TriangleMaker(PolygonMesh& polygons, const MeshFileOptions& options)
      : polygons_(polygons), corners_(polygons.all_corners()), options_(options) {
    made_.resize(polygons.vertices.empty() ? polygons.positions.size() : polygons.vertices.size(),
                 {no_index, no_index});
    uses_normals_ = options.normals == MeshNormals::file && !polygons.normals.empty();
    const auto count = static_cast<std::uint32_t>(made_.size());
    // If each corner is a vertex of its own, as in STL files, equal vertices are close together,
    // and finding them one by one is faster.
    if (2 * made_.size() > corners_.size() || (uses_normals_ && !all_have_normals(count))) return;
    first_equal_ =
        first_equal_vertices(count, [this](std::uint32_t vertex) { return values_of(vertex); });
  }

  void begin(std::uint32_t material, std::span<const Faces> runs) {
    material_ = material;
    std::size_t faces = 0;
    bool normals = false;
    bool uvs = false;
    const bool neither = polygons_.normals.empty() && polygons_.uvs.empty();
    for (const Faces& run : runs) {
      faces += run.last - run.first;
      if (neither) continue;
      std::size_t corner = run.first_corner;
      for (std::size_t face = run.first; face < run.last && !(normals && uvs); ++face)
        for (unsigned k = 0; k < polygons_.face_size(face); ++k, ++corner) {
          const PolygonVertex vertex = vertex_of(corners_[corner]);
          normals |= vertex.normal != no_index;
          uvs |= vertex.uv != no_index;
        }
    }
    has_normals_ = normals && options_.normals == MeshNormals::file;
    const bool has_all_faces = faces == polygons_.faces();
    in_place_ = has_all_faces && !polygons_.triangles.empty();
    // A mesh of all faces uses most vertices. Unused reserved memory costs nothing.
    builder_ = MeshBuilder({has_normals_, uvs, !polygons_.colors.empty()}, faces,
                           has_all_faces && !first_equal_.empty() ? made_.size() : 0);
  }

  void add(const Faces& run) {
    const std::uint32_t* corners = corners_.data() + run.first_corner;
    for (std::size_t face = run.first; face < run.last; ++face) {
      const std::size_t size = polygons_.face_size(face);
      if (in_place_) {
        polygons_.triangles[face] = made(corners, {0, 1, 2});
      } else if (size == 3) {
        add(corners, {0, 1, 2});
      } else {
        points_.clear();
        for (std::size_t k = 0; k < size; ++k) points_.push_back(position_of(corners[k]));
        triangulate(points_, triangles_);
        for (const UVec3& t : triangles_) add(corners, t);
      }
      corners += size;
    }
  }

  [[nodiscard]] Mesh take() {
    Mesh mesh = builder_.take();
    if (in_place_) mesh.triangles = std::move(polygons_.triangles);
    return mesh;
  }

 private:
  // The vertex of the current mesh that a vertex of the file became.
  struct Made {
    std::uint32_t material;
    std::uint32_t vertex;
  };

  [[nodiscard]] PolygonVertex vertex_of(std::uint32_t corner) const {
    if (!polygons_.vertices.empty()) return polygons_.vertices[corner];
    return {corner, polygons_.uvs.empty() ? no_index : corner,
            polygons_.normals.empty() ? no_index : corner};
  }

  [[nodiscard]] const Vec3& position_of(std::uint32_t corner) const {
    return polygons_.positions[vertex_of(corner).position];
  }

  void add(const std::uint32_t* corners, const UVec3& t) {
    builder_.add_triangle(made(corners, t));
  }

  UVec3 made(const std::uint32_t* corners, const UVec3& t) {
    return {made(corners, t, 0), made(corners, t, 1), made(corners, t, 2)};
  }

  // Returns the vertex for corner `k` of the triangle.
  std::uint32_t made(const std::uint32_t* corners, const UVec3& t, int k) {
    const std::uint32_t corner = corners[t[k]];
    const bool is_known_alone = first_equal_.empty();
    Made& known = made_[is_known_alone ? corner : first_equal_[corner]];
    if (known.material == material_) return known.vertex;
    VertexValues values = values_of(corner);
    if (!is_known_alone) {
      known = {material_, builder_.add_new_vertex(values)};
      return known.vertex;
    }
    const bool flat = has_normals_ && !unit_normal(vertex_of(corner), values.normal);
    if (flat) values.normal = flat_normal(corners, t);
    const std::uint32_t result = builder_.add_vertex(values);
    // A flat normal holds for this triangle only.
    if (!flat) known = {material_, result};
    return result;
  }

  // Returns the values of a corner, without a normal if the file has none for it.
  [[nodiscard]] VertexValues values_of(std::uint32_t corner) const {
    const PolygonVertex vertex = vertex_of(corner);
    VertexValues values{polygons_.positions[vertex.position]};
    if (uses_normals_) (void)unit_normal(vertex, values.normal);
    if (vertex.uv != no_index) values.uv = polygons_.uvs[vertex.uv];
    if (!polygons_.colors.empty()) values.color = polygons_.colors[vertex.position];
    return values;
  }

  [[nodiscard]] bool all_have_normals(std::uint32_t count) const {
    return parallel_fold(
               count, 1U << 15, std::uint8_t{1},
               [&](std::size_t first, std::size_t last) {
                 Vec3 normal(0);
                 std::uint8_t valid = 1;
                 for (std::size_t i = first; i < last && valid != 0; ++i)
                   valid = unit_normal(vertex_of(static_cast<std::uint32_t>(i)), normal) ? 1 : 0;
                 return valid;
               },
               [](std::uint8_t& total, std::uint8_t part) { total = std::min(total, part); }) != 0;
  }

  // Returns false if the file has no normal, or one of length 0.
  [[nodiscard]] bool unit_normal(const PolygonVertex& vertex, Vec3& normal) const {
    if (vertex.normal == no_index) return false;
    const DVec3 given(polygons_.normals[vertex.normal]);
    const double length = glm::length(given);
    if (!(length > 0)) return false;
    normal = Vec3(given / length);
    return true;
  }

  [[nodiscard]] Vec3 flat_normal(const std::uint32_t* corners, const UVec3& t) const {
    const DVec3 flat = scaled_normal(
        {position_of(corners[t.x]), position_of(corners[t.y]), position_of(corners[t.z])});
    const double length = glm::length(flat);
    return length > 0 ? Vec3(flat / length) : Vec3(0, 1, 0);
  }

  PolygonMesh& polygons_;
  std::span<const std::uint32_t> corners_;
  const MeshFileOptions& options_;
  std::vector<Made> made_;
  // For each vertex of the file; empty if equal vertices are found one by one.
  std::vector<std::uint32_t> first_equal_;
  bool uses_normals_ = false;
  std::uint32_t material_ = 0;
  bool has_normals_ = false;
  bool in_place_ = false;  // the faces become the mesh's triangles
  MeshBuilder builder_{{}, 0};
  std::vector<Vec3> points_;      // corners of the current face
  std::vector<UVec3> triangles_;  // indices of these points
};

}  // namespace

void make_meshes(PolygonMesh polygons, const MeshFileOptions& options, MeshFile& out) {
  std::uint64_t triangles = 0;
  for (std::size_t face = 0; face < polygons.faces(); ++face)
    triangles += polygons.face_size(face) - 2;
  if (triangles > options.triangles)
    throw MeshFileError("more than " + std::to_string(options.triangles) + " triangles");
  const std::vector<Faces> runs = faces_by_material(polygons, options.merged);
  TriangleMaker maker(polygons, options);
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t next = i;
    std::size_t faces = 0;
    for (; next < runs.size() && runs[next].material == runs[i].material; ++next)
      faces += runs[next].last - runs[next].first;
    if (faces > 0) {
      maker.begin(runs[i].material, {runs.data() + i, next - i});
      for (std::size_t r = i; r < next; ++r) maker.add(runs[r]);
      out.parts.push_back({static_cast<MeshId>(out.meshes.size()), runs[i].material});
      out.meshes.push_back(maker.take());
    }
    i = next;
  }
}

}  // namespace pah
