#include "image/srgb.hpp"

#include "catch.hpp"

using namespace pah;

TEST_CASE("sRGB and linear light convert by known values") {
  CHECK(linear_from_srgb(0.5F) == Approx(0.21404114));
  CHECK(linear_from_srgb(0.5) == Approx(0.21404114));
  CHECK(srgb_from_linear(0.21404114) == Approx(0.5));
  CHECK(linear_from_srgb(0.04) == Approx(0.04 / 12.92));
  CHECK(srgb_from_linear(0.003) == Approx(0.003 * 12.92));
  CHECK(linear_from_srgb(1.0F) == 1);
  CHECK(linear_from_srgb(1.0) == 1);
  CHECK(srgb_from_linear(1.0F) == Approx(1));
  CHECK(linear_from_srgb(-0.5F) == -0.5F / 12.92F);
  CHECK(srgb_from_linear(-0.5F) == -0.5F * 12.92F);
}

TEST_CASE("16-bit sRGB codes survive conversion to linear light and back") {
  int wrong = 0;
  double last = -1;
  for (int code = 0; code < 65536; ++code) {
    const double linear = linear_from_srgb(code / 65535.0);
    const float linear_float = linear_from_srgb(static_cast<float>(code) / 65535.0F);
    wrong += std::lround(65535 * srgb_from_linear(linear)) == code &&
                     std::lround(65535 * srgb_from_linear(linear_float)) == code && linear > last
                 ? 0
                 : 1;
    last = linear;
  }
  CHECK(wrong == 0);
}
