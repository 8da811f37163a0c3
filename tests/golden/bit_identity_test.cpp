// Tests that neither the number of threads nor the accelerator changes a pixel.
#include <tbb/global_control.h>

#include <pah/render/render.hpp>

#include "catch.hpp"
#include "reference.hpp"

using namespace pah;

namespace {

bool identical(const FilmPixel& a, const FilmPixel& b) {
  return a.sum == b.sum && a.error == b.error && a.sum_of_squares == b.sum_of_squares &&
         a.samples == b.samples && a.hits == b.hits;
}

std::size_t count_differing(const Film& a, const Film& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  REQUIRE(a.features.size() == a.pixels.size());
  REQUIRE(b.features.size() == b.pixels.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    differing += identical(a.pixels[i], b.pixels[i]) && a.features[i] == b.features[i] ? 0U : 1U;
  return differing;
}

Film render_few(const World& world, const Accelerator& accelerator, const Scene& scene,
                int threads) {
  RenderSettings settings = scene.render;
  settings.samples = 4;
  FilmSettings film = scene.film;
  film.albedo = film.normal = film.depth = true;
  RenderOptions options;
  options.threads = threads;
  return render(world, accelerator, film, settings, options).film;
}

}  // namespace

TEST_CASE("One, two and seven threads give the same golden pictures to the last bit") {
  const tbb::global_control seven(tbb::global_control::max_allowed_parallelism, 7);
  for (const std::string name : golden::scene_names) {
    CAPTURE(name);
    const Scene scene = golden::load_golden(name).scene;
    const World world = make_world(scene);
    const auto accelerator = make_global_bvh(world.triangles());
    const Film one = render_few(world, *accelerator, scene, 1);
    for (const int threads : {2, 7}) {
      CAPTURE(threads);
      CHECK(count_differing(one, render_few(world, *accelerator, scene, threads)) == 0);
    }
  }
}

TEST_CASE("A BVH gives the same golden pictures as brute force to the last bit") {
  for (const std::string name : golden::scene_names) {
    CAPTURE(name);
    const Scene scene = golden::load_golden(name).scene;
    const World world = make_world(scene);
    const Film expected = render_few(world, *make_brute_force(world.triangles()), scene, 0);
    CHECK(count_differing(expected,
                          render_few(world, *make_global_bvh(world.triangles()), scene, 0)) == 0);
  }
}

TEST_CASE("A difference of one bit is seen") {
  Film film{{0, 2, 0, 1}, {2, FilmPixel{}}, {2, FilmFeatures{}}};
  Film other = film;
  CHECK(count_differing(film, other) == 0);
  other.pixels[1].sum.z = 5e-324;
  CHECK(count_differing(film, other) == 1);
  other.features[0].depth = 5e-324;
  CHECK(count_differing(film, other) == 2);
}
