#include <cmath>
#include <pah/image/compare.hpp>
#include <stdexcept>

#include "catch.hpp"

using namespace pah;

namespace {

Image ones(int width, int height) {
  return {width, height,
          std::vector<glm::vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                 glm::vec3(1))};
}

}  // namespace

TEST_CASE("Images are compared in linear values") {
  Image a = ones(2, 2);
  const Image b = ones(2, 2);
  CHECK(compare_images(a, b).max == 0);
  a.pixels[3].y = 1.5F;
  const ImageDifference d = compare_images(a, b);
  CHECK(d.max == 0.5);
  CHECK(d.mse == Approx(0.25 / 12));
  CHECK(d.relmse == Approx(0.25 / 1.01 / 12));
  a.pixels[0].x = NAN;
  CHECK(std::isinf(compare_images(a, b).max));
  CHECK(std::isinf(compare_images(a, b).relmse));
  CHECK_THROWS_AS(compare_images(a, ones(1, 4)), std::invalid_argument);
}
