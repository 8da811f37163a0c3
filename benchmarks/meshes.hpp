// The scenes that rays and builds are measured on: a mesh on a floor, or a generated scene, under a
// bulb, a sun and a spot.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/scene/world.hpp>
#include <string>
#include <vector>

namespace pah::bench {

struct MeshScene {
  explicit MeshScene(const std::string& mesh);

  static constexpr LightId bulb = 0, sun = 1, spot = 2;

  FilmSettings film;
  RenderSettings render;
  World world;
  // The bulb's and the sun's, which hold the mesh and little else. Generated scenes have none.
  std::vector<LocalArea> areas;
};

// A million triangles, made here: for builds only.
inline constexpr const char* terrain = "terrain";

// A mesh that is made here, then those found in the folder that the environment variable
// PAHRENDER_MESHES names. Says on stderr which are not.
[[nodiscard]] std::vector<std::string> mesh_names();

// Made when first asked for, then kept: a benchmark is called more than once.
[[nodiscard]] const MeshScene& mesh_scene(const std::string& mesh);

}  // namespace pah::bench
