// Tests the costs of rays and their false colors.
#include <numeric>
#include <pah/accel/accelerator.hpp>

#include "bvh/build.hpp"
#include "catch.hpp"
#include "image/srgb.hpp"
#include "render/path/camera_rays.hpp"
#include "report/inspect/pictures/false_color.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

// The brightness of encoded values, which grows evenly in Green's scheme.
double brightness(const Vec3& color) {
  const auto encoded = [&](int channel) {
    return srgb_from_linear(static_cast<double>(color[channel]));
  };
  return 0.3 * encoded(0) + 0.59 * encoded(1) + 0.11 * encoded(2);
}

}  // namespace

TEST_CASE("Every pixel's ray is counted as the accelerator counts it alone") {
  const test::Soup soup = test::random_soup(500, 0.2F, Vec3{0}, 1);
  const Triangles triangles = soup.triangles();
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const Aabb bounds = bounds_of(triangles);
  PerspectiveCamera camera;
  camera.position = DVec3(bounds.center()) + DVec3{0, 0, 4};
  camera.look_at = DVec3(bounds.center());
  FilmSettings film;
  film.width = 24;
  film.height = 16;
  const PictureCosts costs = measure_costs(build_bvh(triangles, all).bvh, camera, film);
  REQUIRE(costs.rays.size() == 24 * 16);

  const auto accelerator = make_global_bvh(triangles);
  const CameraRays rays(camera, film);
  std::uint64_t nodes = 0, tests = 0, hits = 0, wrong = 0;
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x) {
      const Ray ray = rays.central(x, y);
      Hit hit;
      TraversalCounts counts;
      accelerator->closest_hit(std::span(&ray, 1), std::span(&hit, 1), &counts);
      const RayCost& cost = costs.rays[static_cast<std::size_t>(y * film.width + x)];
      wrong += cost.nodes == counts.nodes && cost.triangles == counts.triangles &&
                       cost.hit == hit.valid()
                   ? 0
                   : 1;
      nodes += counts.nodes;
      tests += counts.triangles;
      hits += hit.valid() ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  CHECK(hits > 50);
  const CostSummary sum = summarize(costs);
  CHECK(sum.rays == 24 * 16);
  CHECK(sum.hits == hits);
  CHECK(sum.nodes_per_ray == Approx(static_cast<double>(nodes) / (24 * 16)));
  CHECK(sum.triangles_per_ray == Approx(static_cast<double>(tests) / (24 * 16)));
}

TEST_CASE("Rays through the centers of pixels") {
  PerspectiveCamera camera;
  camera.position = {0, 0, 5};
  camera.look_at = {0, 0, 0};
  camera.fov = 90;
  FilmSettings film;
  film.width = film.height = 4;
  const Ray ray = CameraRays(camera, film).central(3, 0);
  const Vec3 expected = glm::normalize(Vec3{0.75F, 0.75F, -1});
  CHECK(glm::length(ray.direction - expected) < 1e-6F);
  CHECK(ray.origin == Vec3{0, 0, 5});
}

TEST_CASE("False colors grow evenly in brightness, from black to white") {
  CHECK(false_color(0) == Vec3{0});
  CHECK(glm::length(false_color(1) - Vec3{1}) < 1e-6F);
  for (int i = 0; i <= 100; ++i)
    CHECK(brightness(false_color(i / 100.0)) == Approx(i / 100.0).margin(2e-3));
}

TEST_CASE("A heat map has nodes on the left and triangles on the right") {
  PictureCosts costs{2, 2, {{4, 0, true}, {0, 3, false}, {2, 6, true}, {1, 0, false}}};
  const Image image = heat_map(costs);
  REQUIRE(image.width == 4);
  REQUIRE(image.height == 2);
  CHECK(image.at(0, 0) == false_color(1));
  CHECK(image.at(1, 0) == false_color(0));
  CHECK(image.at(0, 1) == false_color(0.5));
  CHECK(image.at(1, 1) == false_color(0.25));
  CHECK(image.at(2, 0) == false_color(0));
  CHECK(image.at(3, 0) == false_color(0.5));
  CHECK(image.at(2, 1) == false_color(1));
  CHECK(image.at(3, 1) == false_color(0));
  for (RayCost& ray : costs.rays) ray = {};
  for (const Vec3& pixel : heat_map(costs).pixels) CHECK(pixel == Vec3{0});
}
