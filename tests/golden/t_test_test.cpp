// Tests the statistical test itself: known values, false alarms and power.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "catch.hpp"
#include "failure_pictures.hpp"
#include "t_test.hpp"

using namespace pah;
using namespace pah::golden;

namespace {

constexpr int width = 64, height = 48;

// Returns a picture with the given mean and normal noise of standard deviation `deviation` in each
// batch.
Batches noisy_picture(double mean, double deviation, int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> standard;
  const auto noise = [&] { return mean + deviation * standard(generator); };
  Batches batches(width, height);
  for (int i = 0; i < count; ++i) {
    std::vector<DVec3> picture(static_cast<std::size_t>(width) * height);
    for (DVec3& pixel : picture) pixel = {noise(), noise(), noise()};
    batches.add(picture);
  }
  return batches;
}

}  // namespace

TEST_CASE("Student's distribution has its known values") {
  CHECK(two_sided_p(0, 5) == Approx(1));
  CHECK(two_sided_p(1, 1) == Approx(0.5));                              // Cauchy
  CHECK(two_sided_p(std::sqrt(2.0), 2) == Approx(1 - std::sqrt(0.5)));  // closed form
  CHECK(two_sided_p(2.2281388519649385, 10) == Approx(0.05));           // tables
  CHECK(two_sided_p(-2.2281388519649385, 10) == Approx(0.05));
  CHECK(two_sided_p(5, 1e7) == Approx(std::erfc(5 / std::sqrt(2.0))).epsilon(1e-4));  // normal
}

TEST_CASE("The Sidak level bounds the chance of any false alarm") {
  CHECK(sidak(0.01, 1) == Approx(0.01));
  CHECK(1 - std::pow(1 - sidak(0.01, 9216), 9216) == Approx(0.01));
}

TEST_CASE("Batches know their mean and variance") {
  Batches batches(1, 1);
  for (const double value : {1.0, 2.0, 6.0}) batches.add({DVec3(value)});
  CHECK(batches.mean()[0].x == Approx(3));
  CHECK(batches.variance(0).x == Approx(7));
  const Batches stored(1, 1, 3, batches.mean(), {batches.variance(0)});
  CHECK(stored.variance(0).x == Approx(7));
}

TEST_CASE("Equal pictures pass, and their p-values are uniform") {
  const Comparison comparison =
      compare(noisy_picture(1, 0.01, 64, 1), noisy_picture(1, 0.01, 4, 2));
  CHECK(comparison.passed >= passing_share);
  // The least of three uniform values is below 1 - 0.9^(1/3) in a tenth of the pixels.
  const double decile = 1 - std::cbrt(0.9);
  const auto below =
      std::count_if(comparison.p.begin(), comparison.p.end(), [&](double p) { return p < decile; });
  const double n = static_cast<double>(comparison.p.size());
  CHECK(std::abs(static_cast<double>(below) - 0.1 * n) < 4 * std::sqrt(0.09 * n));
}

TEST_CASE("One percent more is rejected, and leaves pictures to look at") {
  const Batches reference = noisy_picture(1, 0.004, 64, 1);
  const Batches picture = noisy_picture(1.01, 0.004, 4, 2);
  const Comparison comparison = compare(reference, picture);
  CHECK(comparison.passed < passing_share);
  const auto folder = write_failure("self_test", reference, picture, comparison);
  for (const char* kind : {"_image.exr", "_difference.exr", "_p_value.png"})
    CHECK(std::filesystem::remove(folder / (std::string("self_test") + kind)));
}

TEST_CASE("Pixels without noise may differ by rounding only") {
  const Batches reference = noisy_picture(1, 0, 64, 1);
  CHECK(compare(reference, noisy_picture(1 + 1e-7, 0, 4, 1)).passed == 1);
  CHECK(compare(reference, noisy_picture(1 + 1e-5, 0, 4, 1)).passed == 0);
}
