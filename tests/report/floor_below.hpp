#pragma once

#include <pah/scene/scene.hpp>
#include <pah/scene/shapes.hpp>

namespace pah::test {

// A floor at y = 0 that fills the picture of 16 x 16 pixels, seen from above.
inline Scene floor_below() {
  Scene scene;
  PerspectiveCamera camera;
  camera.position = {0, 4, 0};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 0, 1};
  camera.fov = 90;
  scene.camera = camera;
  scene.film.width = scene.film.height = 16;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(RectangleShape{{1000, 1000}})};
  scene.instances.emplace_back();
  return scene;
}

}  // namespace pah::test
