// A scene made ready for rays: all triangles in one float array, around an origin within the scene.
#pragma once

#include <pah/geometry/triangles.hpp>
#include <pah/scene/scene.hpp>
#include <string>
#include <vector>

namespace pah {

// What all triangles of one instance share.
struct Surface {
  MaterialId material = 0;
  LightId light = no_light;
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  bool has_normals = false;
  bool has_uvs = false;
  bool has_colors = false;
};

struct World {
  // Scene coordinates are origin + world coordinates. The origin is subtracted in double, before
  // rounding to float, so a scene far from zero loses no precision. It is the scene's center; if
  // something is so far away that the center is in empty space, it is the camera's position or aim.
  DVec3 origin{0};
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // per position; empty if no surface has normals
  std::vector<Vec2> uvs;      // per position; empty if no surface has texture coordinates
  std::vector<Vec3> colors;   // per position; empty if no surface has colors
  std::vector<UVec3> indices;
  std::vector<std::uint32_t> surface_of_triangle;
  std::vector<Surface> surfaces;
  Aabb bounds;  // of all triangles; empty if there are none

  // As in the scene, but relative to `origin`.
  Camera camera;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Texture> textures;

  std::vector<std::string> warnings;  // about what the picture cannot show well, one sentence each

  [[nodiscard]] Triangles triangles() const { return {positions, indices}; }
  [[nodiscard]] std::uint64_t bytes() const;
};

// Flattens the scene's instances. Where a transform mirrors (determinant < 0), triangles are turned
// over so that normals keep pointing out. Throws std::length_error beyond 2^32 - 2
// triangles or positions, and std::invalid_argument, naming the mesh, for ids out of range, for a
// transform without inverse, and for numbers that are not finite once transformed.
[[nodiscard]] World make_world(const Scene& scene);

}  // namespace pah
