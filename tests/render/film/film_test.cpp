#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <pah/image/compare.hpp>
#include <pah/render/film.hpp>
#include <random>
#include <stdexcept>
#include <vector>

using namespace pah;

namespace {

Film make_film(int width, int height) {
  Film film;
  film.rect = {0, width, 0, height};
  film.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return film;
}

void add(FilmPixel& pixel, const DVec3& sample) {
  pixel.add_radiance(sample);
  ++pixel.samples;
}

Image constant(int width, int height, float value) {
  return {width, height,
          std::vector<Vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            Vec3(value))};
}

}  // namespace

TEST_CASE("Means and variances of pixels are right") {
  Film film = make_film(2, 1);
  FilmPixel& pixel = film.at(0, 0);
  for (const double x : {1.0, 2.0, 6.0}) add(pixel, {x, 2 * x, 0});
  pixel.hits = 2;
  CHECK(albedo_of(film).at(0, 0) == Vec3(0));
  film.features.resize(2);
  *film.features_at(0, 0) = {{1.5, 3, 0}, {0, 3, 0}, 10};
  CHECK(radiance_of(film).at(0, 0) == Vec3(3, 6, 0));
  CHECK(radiance_of(film).at(1, 0) == Vec3(0));
  CHECK(albedo_of(film).at(0, 0) == Vec3(0.5F, 1, 0));
  CHECK(normal_of(film).at(0, 0) == Vec3(0, 1, 0));
  CHECK(depth_of(film).at(0, 0) == Vec3(5));
  CHECK(depth_of(film).at(1, 0) == Vec3(0));
  // The variance of the samples is 7, that of their mean a third of it.
  CHECK(variance_of(film).at(0, 0).x == Approx(7.0 / 3));
  CHECK(variance_of(film).at(0, 0).y == Approx(28.0 / 3));
  CHECK(variance_of(film).at(1, 0) == Vec3(0));
}

TEST_CASE("A part of a film has the same means, where the film is a part itself") {
  Film film = make_film(4, 3);
  film.rect = {10, 14, 20, 23};
  for (std::size_t i = 0; i < film.pixels.size(); ++i) add(film.pixels[i], DVec3(0.1) * double(i));
  const Image part = radiance_of(film, {11, 13, 21, 23});
  CHECK(part.width == 2);
  CHECK(part.height == 2);
  const Image all = radiance_of(film);
  CHECK(part.pixels == std::vector<Vec3>{all.at(1, 1), all.at(2, 1), all.at(1, 2), all.at(2, 2)});
}

TEST_CASE("The error lies within its predicted interval") {
  // Pixels have many brightnesses, skewed noise and known means.
  std::mt19937 random(7);
  for (const int samples : {4, 16, 64}) {
    int covered = 0;
    double ratio = 0;
    const int runs = 40;
    for (int run = 0; run < runs; ++run) {
      Film film = make_film(64, 32);
      Image truth = constant(64, 32, 0);
      for (int i = 0; i < 64 * 32; ++i) {
        const double mean = 0.05 + 2.0 * i / (64 * 32);
        truth.pixels[static_cast<std::size_t>(i)] = Vec3(static_cast<float>(mean));
        std::exponential_distribution<double> sample(1 / mean);
        for (int s = 0; s < samples; ++s)
          add(film.pixels[static_cast<std::size_t>(i)],
              {sample(random), sample(random), sample(random)});
      }
      const ErrorEstimate estimate = estimate_error(film);
      const ImageDifference actual = compare_images(radiance_of(film), truth);
      ratio += estimate.relmse / actual.relmse / runs;
      covered += estimate.low <= actual.relmse && actual.relmse <= estimate.high;
      CHECK(estimate.mse == Approx(actual.mse).epsilon(0.25));
    }
    CAPTURE(samples, ratio, covered);
    CHECK(ratio == Approx(1).epsilon(1.0 / samples));
    CHECK(covered >= 36);
  }
}

TEST_CASE("An unknown error is infinite") {
  Film film = make_film(2, 1);
  CHECK(std::isinf(estimate_error(film).relmse));
  add(film.at(0, 0), DVec3{1});
  CHECK(std::isinf(estimate_error(film).high));
  add(film.at(0, 0), DVec3{1});
  CHECK(estimate_error(film).relmse == 0);
  CHECK(estimate_error(film).high == 0);
}

namespace {

// Returns the relative error of the mean of `count` samples of a constant.
double drift_of(float constant, int count) {
  FilmPixel pixel;
  for (int i = 0; i < count; ++i) add(pixel, DVec3(constant));
  return std::abs(pixel.radiance().x / count / constant - 1);
}

}  // namespace

TEST_CASE("A sum of many samples does not drift") {
  for (const float constant : {0.1F, 0.5F, 1e-20F, 3e7F})
    CHECK(drift_of(constant, 3'000'000) < 1e-15);
  // The sum does not depend on the order of the samples.
  std::mt19937 random(1);
  std::vector<float> samples;
  for (int i = 0; i < 10'000; ++i)
    samples.push_back(
        std::ldexp(static_cast<float>(random() >> 8U), -static_cast<int>(random() % 40)));
  FilmPixel forth, back;
  for (const float sample : samples) add(forth, DVec3(sample));
  std::reverse(samples.begin(), samples.end());
  for (const float sample : samples) add(back, DVec3(sample));
  CHECK(forth.radiance() == back.radiance());
}

TEST_CASE("A sum of 1e8 samples does not drift", "[full]") {
  for (const float constant : {0.1F, 0.5F}) CHECK(drift_of(constant, 100'000'000) < 1e-15);
}

TEST_CASE("Films add up to the radiance of the whole, without error, in any split and order") {
  std::mt19937 random(5);
  std::lognormal_distribution<float> radiance(0, 4);
  std::vector<DVec3> samples;
  for (int i = 0; i < 1000; ++i)
    samples.emplace_back(radiance(random), radiance(random), radiance(random));
  Film whole = make_film(1, 1);
  for (const DVec3& sample : samples) add(whole.pixels[0], sample);
  for (int split = 0; split < 50; ++split) {
    std::vector<Film> parts(7, make_film(1, 1));
    for (const DVec3& sample : samples) add(parts[random() % parts.size()].pixels[0], sample);
    Film sum = make_film(1, 1);
    for (const Film& part : parts) add(sum, part);
    CHECK(sum.pixels[0].radiance() == whole.pixels[0].radiance());
    CHECK(sum.pixels[0].samples == 1000);
    CHECK(variance_of(sum).at(0, 0).x == Approx(variance_of(whole).at(0, 0).x));
  }
}

TEST_CASE("Films that are added keep hits and features, and must be alike") {
  Film film = make_film(1, 1);
  film.pixels[0].hits = 3;
  film.features = {{DVec3{1, 2, 3}, DVec3{4, 5, 6}, 7}};
  Film sum = film;
  add(sum, film);
  CHECK(sum.pixels[0].hits == 6);
  CHECK(sum.features[0] == FilmFeatures{DVec3{2, 4, 6}, DVec3{8, 10, 12}, 14});
  CHECK_THROWS_AS(add(sum, make_film(1, 1)), std::invalid_argument);
  CHECK_THROWS_AS(add(sum, make_film(2, 1)), std::invalid_argument);
}
