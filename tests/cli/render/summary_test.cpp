// The last line of a render.
#include "cli/terminal/summary.hpp"

#include <algorithm>
#include <vector>

#include "catch.hpp"

using namespace pah;
using namespace pah::cli;

namespace {

// Returns pixels with the given numbers of samples. The samples alternate between 1 + spread and
// 1 - spread.
RenderResult picture(const std::vector<int>& samples, double spread) {
  RenderResult result;
  result.film.rect = {0, static_cast<int>(samples.size()), 0, 1};
  for (const int count : samples) {
    FilmPixel pixel;
    for (int i = 0; i < count; ++i) {
      pixel.add_radiance(DVec3(i % 2 == 0 ? 1 + spread : 1 - spread));
      ++pixel.samples;
    }
    result.film.pixels.push_back(pixel);
  }
  result.samples = *std::ranges::min_element(samples);
  result.seconds = 2;
  result.counts.rays = {3'000'000, 2'000'000, 1'000'000};
  return result;
}

RenderResult complete(RenderResult result) {
  result.complete = true;
  return result;
}

}  // namespace

TEST_CASE("The last line tells size, samples, seconds, rays a second and the error") {
  // The relative variance is about 0.25 / 64, and so the error is 1/16.
  CHECK(summary_of("out.png", complete(picture({64, 64, 64}, 0.5)), 64, 12.3) ==
        "wrote out.png: 3 x 1, 64 samples, 12 s, 3.0 Mrays/s, "
        "error about 6.3 % (256 samples would halve it)\n");
}

TEST_CASE("One sample gives no estimate of the error") {
  CHECK(summary_of("out.png", complete(picture({1, 1}, 0.5)), 1, 0.5) ==
        "wrote out.png: 2 x 1, 1 samples, 0.5 s, 3.0 Mrays/s\n");
  // Some pixels have two samples, but not all.
  CHECK(format_error(picture({2, 1}, 0.5)).empty());
}

TEST_CASE("An error has two digits, and no hint if it is zero") {
  CHECK(format_error(complete(picture({2, 2}, 0.5))) ==
        "error about 57 % (8 samples would halve it)");
  CHECK(format_error(complete(picture({64, 64}, 0.01))) ==
        "error about 0.13 % (256 samples would halve it)");
  CHECK(format_error(complete(picture({4, 4}, 0))) == "error below 0.01 %");
}

TEST_CASE("An unfinished pass counts by the mean of its samples") {
  CHECK(format_samples(picture({12, 12, 14}, 0.5), 64) == "12.7 of 64");
  CHECK(format_samples(picture({12, 12}, 0.5), 64) == "12 of 64");
  CHECK(format_samples(picture({0, 0, 1}, 0.5), 64) == "0.33 of 64");
  CHECK(format_samples(complete(picture({64, 64}, 0.5)), 64) == "64");
  CHECK(format_error(picture({12, 12, 14}, 0.5)).ends_with("(51 samples would halve it)"));
  // Some samples were not finite and are left out.
  RenderResult faulty = picture({11, 12}, 0.5);
  faulty.samples = 12;
  CHECK(format_samples(faulty, 64) == "12 of 64");
}
