// Meshes and where they stand.
#pragma once

#include <pah/geometry/vec.hpp>
#include <pah/scene/material.hpp>
#include <string>
#include <vector>

namespace pah {

using MeshId = std::uint32_t;
using LightId = std::uint32_t;
inline constexpr LightId no_light = 0xFFFFFFFFU;

// Geometry in its own coordinates, loaded once however often it is used. At least one triangle,
// every index in range, every coordinate finite.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // one per position, of unit length, or none (flat shading)
  std::vector<Vec2> uvs;      // one per position, or none; v grows upwards in the image
  std::vector<UVec3> triangles;
  std::vector<Vec3> colors;  // linear, one per position, or none; for materials that ask for them
};

// A mesh in the scene. If it emits, `light` is the area light that it belongs to.
struct Instance {
  MeshId mesh = 0;
  MaterialId material = 0;
  LightId light = no_light;
  glm::dmat4x3 world_from_object{1.0};  // affine and invertible
};

}  // namespace pah
