// A scene: values that refer to one another by index. load_scene() makes one from a file; a program
// can also fill one in and pass it to make_world().
#pragma once

#include <pah/image/texture.hpp>
#include <pah/scene/camera.hpp>
#include <pah/scene/light.hpp>
#include <pah/scene/material.hpp>
#include <pah/scene/mesh.hpp>
#include <pah/scene/settings.hpp>

namespace pah {

struct Scene {
  Camera camera = PerspectiveCamera{};
  FilmSettings film;
  RenderSettings render;
  InfluenceSettings influence_areas;
  AccelerationSettings acceleration;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Light> lights;
};

}  // namespace pah
