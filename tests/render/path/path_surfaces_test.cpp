// Tests rays that leave and reach surfaces without meeting them again, and shading normals.
#include <algorithm>
#include <array>
#include <random>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "render/light/lights.hpp"
#include "render/sampling/warp.hpp"
#include "render/surface/surface_interaction.hpp"

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

TEST_CASE("Rays spawned from a convex body never meet it again") {
  Random random;
  for (const double scale : {1e-6, 1.0, 1e7}) {
    for (const bool far_away : {false, true}) {
      SceneBuilder builder(scale, far_away ? DVec3(1e6, -1e6, 1e6) * scale : DVec3(0));
      builder.add(SphereShape{0.5, 24, 12}, 0, turned(20, glm::normalize(DVec3(1, 2, 3))));
      // A distant object widens the world, so that the body is not in its middle.
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
        // Rays from the curved surface, in all directions that it faces.
        rays.push_back(spawn_ray(lifted_point(at, at.lift(at.normal)),
                                 make_frame(at.normal).world_from_local(local), at.normal));
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

TEST_CASE("Segments to a lamp never end in the lamp itself") {
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
      const auto sample = lights.sample(lamp, at, {random.next(), random.next_2d()});
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

TEST_CASE("A coarse smooth ball has the terminator of a true ball") {
  const double radius = 0.5;
  const int segments = 24, size = 256;
  SceneBuilder builder;
  // Rotated, so that no edge runs along the terminator.
  builder.add(SphereShape{radius, segments, segments / 2}, builder.diffuse(1),
              turned(5, {0, 1, 0}));
  builder.light(DirectionalLight{{-1, 0, 0}, Vec3(1)});
  builder.look_parallel({0, 0, 5}, {0, 0, 0}, 1, {0, 1, 0});
  builder.film(size, 1);
  builder.scene.film.filter_radius = 1e-6;  // the middle of each pixel
  builder.scene.render.max_depth = 1;
  const RenderResult result = render_scene(builder.scene);

  // The normal at P is P / |P|, and on facets of 15 degrees |P| is at least this of the radius.
  const double least = std::pow(std::cos(pi / segments), 2);
  // A facet within the rows and columns looked at faces the camera to within 25 degrees about the
  // axis: along a row, P moves by at most dx / cos(25 degrees), the normal by that / |P|.
  const double steepest = 1 / (size * std::cos(25 * pi / 180) * radius * least * pi);
  int lit = 0;
  double largest_step = 0;
  bool monotonic = true, bounded = true;
  for (int y = size / 4 + 1; y < size * 3 / 4; ++y) {
    double before = 0;
    for (int x = size * 3 / 8; x < size * 5 / 8; ++x) {
      const double value = result.film.at(x, y).sum.y, place = (x + 0.5) / size - 0.5;
      const double lambert = std::max(0.0, place) / radius / pi;
      bounded = bounded && value >= lambert * (1 - 1e-5) && value <= lambert / least * (1 + 1e-5);
      monotonic = monotonic && value >= before;
      largest_step = std::max(largest_step, value - before);
      before = value;
      lit += value > 0 ? 1 : 0;
    }
  }
  CHECK(bounded);
  CHECK(monotonic);
  INFO("largest step " << largest_step << ", bound " << steepest);
  CHECK(largest_step <= steepest);
  CHECK(lit == (size / 2 - 1) * size / 8);
}

TEST_CASE("No light leaks into closed coarse bodies, whatever their normals") {
  for (const Shape& shape :
       std::array<Shape, 2>{SphereShape{1, 12, 6}, TorusShape{1, 0.6, 12, 8}}) {
    SceneBuilder builder;
    builder.add(shape, builder.diffuse(1), moved({-0.8, 0, 0}));
    builder.light(EnvironmentLight{});
    builder.light(DirectionalLight{{-1, -1, -1}, Vec3(1)});
    builder.look({0, 0, 0.1}, {-0.1, 0.1, 0.5}, 120);
    builder.film(64, 64);
    builder.scene.render.max_depth = 1;
    INFO("shape " << shape.index());
    CHECK(estimate(builder.scene).mean == 0);
  }
}

TEST_CASE("Flat facets are left alone to the last bit") {
  const World turned_box = [] {
    SceneBuilder builder;
    builder.add(BoxShape{}, 0, turned(20, glm::normalize(DVec3(1, 2, 3))));
    return make_world(builder.scene);
  }();
  REQUIRE(turned_box.surfaces[0].has_normals);
  for (std::uint32_t i = 0; i < turned_box.surfaces[0].triangle_count; ++i) {
    Hit hit;
    hit.u = 0.3F;
    hit.v = 0.2F;
    hit.triangle = i;
    CHECK_FALSE(interact(turned_box, hit).curved);
  }

  SceneBuilder builder;
  PlasticMaterial plastic;
  builder.add(BoxShape{}, builder.material(plastic));
  builder.add(RectangleShape{{4, 4}}, builder.diffuse(0.5F), moved({0, -0.5, 0}));
  builder.light(AreaLight{Vec3(6), true});
  builder.add(RectangleShape{{0.5, 0.5}}, 0, moved({0, 2, 1}), 0);
  builder.light(PointLight{{3, 0.6, 1}, Vec3(5)});
  builder.look({2, 2, 4}, {0, 0, 0}, 30);
  builder.film(32, 16);
  const RenderResult with = render_scene(builder.scene);
  for (Mesh& mesh : builder.scene.meshes) mesh.normals.clear();
  CHECK(identical(with.film, render_scene(builder.scene).film));
}

TEST_CASE("Light fades out where it grazes a flat facet with a leaning normal") {
  CHECK(terminator_fade({0, 1, 0}, {0, 1, 0}, glm::normalize(Vec3(5, 0.001F, 0))) == 1);

  SceneBuilder builder;
  builder.add(RectangleShape{{1, 1}}, builder.diffuse(1));
  for (Vec3& normal : builder.scene.meshes[0].normals) normal = {0.6F, 0.8F, 0};
  builder.look_parallel({0, 5, 0}, {0, 0, 0}, 0.1);
  builder.film(4, 1);
  builder.scene.render.max_depth = 1;
  for (const double elevation : {0.001, 1.0, 10.0, 30.0}) {
    const double x = std::cos(elevation * pi / 180), y = std::sin(elevation * pi / 180);
    builder.scene.lights.clear();
    builder.light(DirectionalLight{{-x, -y, 0}, Vec3(1)});
    const double lambert = 0.6 * x + 0.8 * y, g = y / (lambert * 0.8);
    INFO("elevation " << elevation);
    CHECK(estimate(builder.scene).mean ==
          Approx(lambert / pi * (g < 1 ? g + g * g - g * g * g : 1)).epsilon(1e-4));
  }
}

TEST_CASE("A shading normal never turns away from the eye") {
  const Vec3 geometric(0, 0, 1), wo = glm::normalize(Vec3(1, 0, 0.1F));
  const Vec3 shading = glm::normalize(Vec3(-1, 0, 0.5F));
  const Vec3 seen = visible_normal(shading, geometric, wo);
  CHECK(glm::dot(seen, wo) > 0);
  CHECK(glm::length(seen) == Approx(1));
  CHECK(glm::dot(seen, geometric) > glm::dot(shading, geometric));
  CHECK(visible_normal(geometric, geometric, wo) == geometric);
}
