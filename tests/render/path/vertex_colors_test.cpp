// Tests vertex colors, interpolated over triangles and multiplied with the material.
#include "analytic_scenes.hpp"
#include "catch.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// A unit square that faces +y, seen from above; red grows with x, green with -z. With an index of
// refraction of 1 a principled material is diffuse.
Scene colored_square(bool asked_for) {
  SceneBuilder builder;
  const MaterialId paint =
      builder.material(PrincipledMaterial{.base_color = {Vec3(0.5F)}, .ior = 1});
  builder.scene.materials[paint].vertex_colors = asked_for;
  builder.add(RectangleShape{{1, 1}}, paint);
  Mesh& mesh = builder.scene.meshes.back();
  for (const Vec3& p : mesh.positions) mesh.colors.emplace_back(p.x + 0.5F, 0.5F - p.z, 1);
  builder.light(DirectionalLight{{0, -1, 0}, Vec3(2)});
  builder.look_parallel({0, 1, 0}, {0, 0, 0}, 1);
  builder.film(8, 256);
  builder.scene.render.max_depth = 1;
  return builder.scene;
}

}  // namespace

TEST_CASE("Colors of vertices multiply the base color, interpolated") {
  for (const bool asked_for : {true, false}) {
    const Film film = render_scene(colored_square(asked_for)).film;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        INFO("pixel " << x << ", " << y << ", asked for " << asked_for);
        const FilmPixel& pixel = film.at(x, y);
        const DVec3 mean = pixel.sum / static_cast<double>(pixel.samples);
        const DVec3 color = asked_for ? DVec3((x + 0.5) / 8, (7.5 - y) / 8, 1) : DVec3(1);
        for (int k = 0; k < 3; ++k) CHECK(mean[k] == Approx(0.5 * 2 / pi * color[k]).margin(1e-3));
      }
  }
}
