// Polygons of OBJ, PLY, STL and glTF files, and their conversion to meshes of triangles.
#pragma once

#include <cstdint>
#include <pah/load/mesh_file.hpp>
#include <span>
#include <vector>

namespace pah {

inline constexpr std::uint32_t no_index = 0xFFFFFFFF;
inline constexpr std::size_t max_polygon_corners = 10'000;  // triangulation takes quadratic time

// Indices of a position, a texture coordinate and a normal; no_index if absent.
struct PolygonVertex {
  std::uint32_t position;
  std::uint32_t uv;
  std::uint32_t normal;
};

struct PolygonMesh {
  std::vector<Vec3> positions;  // finite, as are the others
  std::vector<Vec2> uvs;
  std::vector<Vec3> normals;  // of any length
  std::vector<Vec3> colors;   // one per position, or none
  // If empty, vertex i has position, texture coordinate and normal i; there are then as many of
  // these as positions, or none.
  std::vector<PolygonVertex> vertices;
  std::vector<std::uint32_t> corners;     // vertices of all faces, one face after the other
  std::vector<std::uint16_t> face_sizes;  // in corners: 3 to max_polygon_corners
  std::vector<UVec3> triangles;           // all faces, instead of corners and face_sizes

  // Faces from `first_face` to the next run have `material`. Without runs, all have material 0.
  struct Run {
    std::size_t first_face;
    std::uint32_t material;
  };
  std::vector<Run> runs;

  [[nodiscard]] std::size_t faces() const {
    return triangles.empty() ? face_sizes.size() : triangles.size();
  }
  [[nodiscard]] std::size_t face_size(std::size_t face) const {
    return triangles.empty() ? face_sizes[face] : 3;
  }
  // All corners, from `corners` or from `triangles`.
  [[nodiscard]] std::span<std::uint32_t> all_corners() {
    if (triangles.empty()) return corners;
    return {&triangles.front().x, 3 * triangles.size()};
  }
};

// Adds one mesh and one part for each material that has faces, or one mesh of material 0 with
// `options.merged`; with normals if `options` asks for the file's.
void make_meshes(PolygonMesh polygons, const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
