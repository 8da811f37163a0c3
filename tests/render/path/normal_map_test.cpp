// Tests that normal maps lean towards growing u and v, also if texture coordinates and objects are
// rotated or mirrored.
#include <numbers>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>

#include "catch.hpp"

using namespace pah;

namespace {

// A square in z = 0 under a camera that looks down at it. The texture coordinates are given at
// (0, 0), (1, 0) and (0, 1).
Scene square(const Vec2& at_0, const Vec2& at_x, const Vec2& at_y) {
  Scene scene;
  OrthographicCamera camera;
  camera.position = {0.5, 0.5, 5};
  camera.look_at = {0.5, 0.5, 0};
  camera.up = {0, 1, 0};
  camera.height = 0.5;
  scene.camera = camera;
  scene.film.width = scene.film.height = 4;
  scene.render.samples = 4;
  scene.render.max_depth = 1;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.uvs = {at_0, at_x, at_x + at_y - at_0, at_y};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  return scene;
}

double mean_of(const Scene& scene) {
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  const Film film = render(world, *acceleration.accelerator, scene.film, scene.render).film;
  double sum = 0;
  double count = 0;
  for (const auto& pixel : film.pixels) {
    sum += pixel.sum.x;
    count += pixel.samples;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("A bump stays a bump where texture coordinates are mirrored") {
  const Vec3 lean = glm::normalize(Vec3(0.3F, 0.5F, 0.8F));  // by u, v and normal
  struct Layout {
    Vec2 at_0, at_x, at_y;
    Vec3 growing_u, growing_v;
  };
  const Vec3 x{1, 0, 0};
  const Vec3 y{0, 1, 0};
  for (const Layout& layout : {Layout{{0, 0}, {1, 0}, {0, 1}, x, y},
                               {{1, 0}, {0, 0}, {1, 1}, -x, y},
                               {{0, 1}, {1, 1}, {0, 0}, x, -y},
                               {{1, 1}, {0, 1}, {1, 0}, -x, -y},
                               {{0, 0}, {0, 1}, {1, 0}, y, x},
                               {{0, 1}, {0, 0}, {1, 1}, y, -x}})
    for (const bool mirrored : {false, true}) {
      CAPTURE(layout.growing_u.x, layout.growing_u.y, layout.growing_v.x, layout.growing_v.y);
      CAPTURE(mirrored);
      Scene scene = square(layout.at_0, layout.at_x, layout.at_y);
      Vec3 mirror(1);
      if (mirrored) {
        mirror.x = -1;
        scene.instances[0].world_from_object[0].x = -1;
        scene.instances[0].world_from_object[3].x = 1;
      }
      CheckerTexture map;
      map.a = map.b = 0.5F * lean + 0.5F;
      scene.textures.emplace_back(map);
      Material material{"bumpy", DiffuseMaterial{ColorInput{Vec3(0.5F)}}};
      material.normal_map = 0;
      scene.materials.push_back(material);
      // The light comes along the normal, so all of it arrives.
      const Vec3 normal = lean.x * layout.growing_u * mirror + lean.y * layout.growing_v * mirror +
                          lean.z * Vec3(0, 0, 1);
      scene.lights.push_back({"sun", DirectionalLight{DVec3(-normal), Vec3(1)}});
      CHECK(mean_of(scene) == Approx(0.5 / std::numbers::pi).epsilon(1e-4));
    }
}
