// Checks of meshes for tests.
#pragma once

#include <array>
#include <map>
#include <pah/scene/mesh.hpp>
#include <utility>

namespace pah {

using Point = std::array<float, 3>;

inline Point point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

// Counts each directed edge; vertices with the same position are the same.
inline std::map<std::pair<Point, Point>, int> edges_of(const Mesh& mesh) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      ++edges[{point_of(mesh.positions[t[k]]), point_of(mesh.positions[t[(k + 1) % 3]])}];
  return edges;
}

// Returns whether every edge is shared by exactly two triangles of opposite direction.
inline bool is_closed(const Mesh& mesh) {
  const auto edges = edges_of(mesh);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || edge.first == edge.second) return false;
  }
  return !edges.empty();
}

inline double area_of(const Mesh& mesh) {
  double area = 0;
  for (const UVec3& t : mesh.triangles) {
    const DVec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

// Returns the volume of a closed mesh; negative if it is inside out.
inline double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const UVec3& t : mesh.triangles) {
    const DVec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return volume;
}

}  // namespace pah
