// Leaving and reaching surfaces without meeting them again, and shading normals.
#include <algorithm>
#include <random>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "render/lights.hpp"
#include "render/surface_interaction.hpp"
#include "render/warp.hpp"

using namespace pah;
using namespace pah::test;

namespace {

struct Random {
  std::mt19937 engine{7};
  float next() { return static_cast<float>(engine() >> 8U) * 0x1p-24F; }
  Vec2 next_2d() {
    const float x = next();
    return {x, next()};
  }
};

}  // namespace

TEST_CASE("rays spawned from a convex body never meet it again") {
  Random random;
  for (const double scale : {1e-6, 1.0, 1e7}) {
    for (const bool far_away : {false, true}) {
      SceneBuilder builder(scale, far_away ? DVec3(1e6, -1e6, 1e6) * scale : DVec3(0));
      builder.add(SphereShape{0.5, 24, 12}, 0, turned(20, glm::normalize(DVec3(1, 2, 3))));
      // Something far off widens the world, so that the body is not in its middle.
      builder.add(RectangleShape{{0.01, 0.01}}, 0, moved({50, 0, 0}));
      const World world = make_world(builder.scene);
      const auto bvh = make_global_bvh(world.triangles());
      const auto count = static_cast<float>(world.surfaces[0].triangle_count);
      std::vector<Ray> rays;
      for (int i = 0; i < 150000; ++i) {
        Hit hit;
        const Vec2 b = sample_uniform_triangle(random.next_2d());
        hit.u = b.x;
        hit.v = b.y;
        hit.t = 1;
        hit.triangle = static_cast<std::uint32_t>(random.next() * count);
        const SurfaceInteraction at = interact(world, hit);
        if (at.point.normal == Vec3(0)) continue;
        // Half of them graze.
        Vec3 local = sample_uniform_cone(random.next_2d(), 1);
        if (i % 2 == 0) local.z *= 1e-3F;
        const Vec3 direction = make_frame(at.point.normal).world_from_local(local);
        if (glm::dot(direction, at.point.normal) > 0) {
          rays.push_back(spawn_ray(at.point, direction));
        }
      }
      std::vector<Hit> hits(rays.size());
      bvh->closest_hit(rays, hits);
      std::size_t met = 0;
      for (const Hit& hit : hits) {
        met += hit.valid() && hit.triangle < world.surfaces[0].triangle_count ? 1 : 0;
      }
      INFO("scale " << scale << (far_away ? " far away" : ""));
      CHECK(met == 0);
    }
  }
}

TEST_CASE("segments to a lamp never end in the lamp itself") {
  Random random;
  for (int scene = 0; scene < 60; ++scene) {
    SceneBuilder builder(scene % 3 == 0 ? 1e-6 : scene % 3 == 1 ? 1.0 : 1e7);
    const LightId lamp = builder.light(AreaLight{Vec3(1), true});
    const glm::dmat4 anywhere =
        moved({4 * random.next() - 2, 4 * random.next() - 2, 4 * random.next() - 2}) *
        turned(360 * random.next(),
               glm::normalize(DVec3(random.next(), random.next(), random.next())));
    builder.add(RectangleShape{{1, 0.1 + random.next()}}, 0, anywhere, lamp);
    builder.add(BoxShape{{8, 8, 8}}, 0);
    const World world = make_world(builder.scene);
    const TextureStore textures(world.textures);
    const Lights lights(world, textures);
    const auto answer = make_brute_force({world.positions, {world.indices.data(), 2}});
    const float size = world.bounds.extent().x;
    std::vector<Ray> rays;
    for (int i = 0; i < 20000; ++i) {
      LitPoint at;
      at.position = Vec3(random.next() - 0.5F, random.next() - 0.5F, random.next() - 0.5F) * size;
      at.normal = Vec3(0, 1, 0);
      at.transmits = true;
      const auto sample = lights.sample(lamp, at, random.next(), random.next_2d());
      if (!sample) continue;
      const SurfacePoint from{at.position, rounding_bound(7) * glm::abs(at.position), at.normal};
      rays.push_back(spawn_segment(from, sample->target, sample->target_error, lamp));
      CHECK(rays.back().t_max <= 1);
    }
    std::vector<std::uint8_t> occluded(rays.size());
    answer->occluded(rays, occluded);
    CHECK(std::count(occluded.begin(), occluded.end(), 1) == 0);
  }
}

TEST_CASE("the terminator fades on coarse smooth meshes and is left alone on flat ones") {
  CHECK(terminator_fade({0, 1, 0}, {0, 1, 0}, glm::normalize(Vec3(5, 0.001F, 0))) == 1);

  // A coarse ball with smooth normals under parallel light from the side: along its equator,
  // brightness falls from facet to facet, without a facet that is dark before the last lit one.
  SceneBuilder builder;
  const int segments = 24;
  builder.add(SphereShape{0.5, segments, 12}, builder.diffuse(1));
  builder.light(DirectionalLight{{-1, 0, 0}, Vec3(1)});
  builder.look_parallel({0, 0, 5}, {0, 0, 0}, 1, {0, 1, 0});
  builder.film(256, 16);
  builder.scene.render.max_depth = 1;
  const RenderResult result = render_scene(builder.scene);
  std::vector<double> brightness;
  for (int facet = 0; facet < segments / 2; ++facet) {
    // Rows of pixels just above the equator; a facet's columns, from the lit side on.
    const double from = 0.5 * std::cos(2 * pi * (facet + 0.1) / segments);
    const double to = 0.5 * std::cos(2 * pi * (facet + 0.9) / segments);
    double sum = 0, n = 0;
    for (int y = 120; y < 127; ++y) {
      for (int x = 0; x < 256; ++x) {
        const double place = (x + 0.5) / 256 - 0.5;
        if (place > from || place < to) continue;
        sum += result.film.at(x, y).sum.y;
        n += result.film.at(x, y).hits;
      }
    }
    if (n > 0) brightness.push_back(sum / n);
  }
  REQUIRE(brightness.size() >= 10);
  for (std::size_t i = 1; i < brightness.size(); ++i) {
    INFO("facet " << i << ": " << brightness[i - 1] << ", " << brightness[i]);
    CHECK(brightness[i] <= brightness[i - 1] * 1.001);
  }
  CHECK(brightness.back() == 0);
  CHECK(brightness.front() > 0.25);
}

TEST_CASE("a shading normal never turns away from the eye") {
  const Vec3 geometric(0, 0, 1), wo = glm::normalize(Vec3(1, 0, 0.1F));
  const Vec3 shading = glm::normalize(Vec3(-1, 0, 0.5F));
  const Vec3 seen = visible_normal(shading, geometric, wo);
  CHECK(glm::dot(seen, wo) > 0);
  CHECK(glm::length(seen) == Approx(1));
  CHECK(glm::dot(seen, geometric) > glm::dot(shading, geometric));
  CHECK(visible_normal(geometric, geometric, wo) == geometric);
}
