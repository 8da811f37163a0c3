#include "report/study/stage.hpp"

#include <algorithm>
#include <pah/geometry/aabb.hpp>
#include <pah/scene/shapes.hpp>

namespace pah {
namespace {

// In double, because the extent may exceed a float.
glm::dmat4x3 on_the_floor(const Mesh& mesh) {
  Aabb box;
  for (const Vec3& position : mesh.positions) box.extend(position);
  const DVec3 low(box.min);
  const DVec3 high(box.max);
  const DVec3 size = high - low;
  const double scale = 2 / std::max({size.x, size.y, size.z});
  const DVec3 foot{(low.x + high.x) / 2, low.y, (low.z + high.z) / 2};
  return {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, -scale * foot};
}

}  // namespace

Scene make_stage() {
  Scene scene;
  scene.camera = PerspectiveCamera{{1.7, 1.8, 3.6}, {0, 0.9, 0}, {0, 1, 0}, 28, 0, {}};
  scene.film.width = scene.film.height = 128;
  scene.render.max_depth = 4;
  scene.materials.emplace_back();
  scene.lights = {{"bulb", PointLight{{-1.6, 3.2, 2.2}, Vec3{36}}},
                  {"sun", DirectionalLight{{-1, -2, -1}, Vec3{3}, 0}}};
  scene.meshes.push_back(make_mesh(RectangleShape{{8, 8}}));
  scene.instances.emplace_back();
  return scene;
}

void put_on_stage(Scene& stage, Mesh mesh) {
  Instance instance;
  instance.mesh = static_cast<MeshId>(stage.meshes.size());
  instance.world_from_object = on_the_floor(mesh);
  stage.meshes.push_back(std::move(mesh));
  stage.instances.push_back(instance);
}

}  // namespace pah
