// Samples a lat-long picture in proportion to its brightness.
#pragma once

#include <cstdint>
#include <pah/geometry/vec.hpp>
#include <span>
#include <vector>

namespace pah {

// Convert between directions in the light's own frame and texture coordinates, v from the top: the
// picture's center is direction -z, its top +y, and u grows to the right, towards +x.
[[nodiscard]] Vec2 lat_long_from_direction(const Vec3& direction);
[[nodiscard]] Vec3 direction_from_lat_long(const Vec2& uv);

// A piecewise constant density over a lat-long picture, per solid angle.
class LatLongDistribution {
 public:
  struct Sample {
    Vec3 direction{0};
    float pdf = 0;  // per steradian
  };

  // `brightness`: the mean of each texel's color, rows from the top, >= 0. A texel's weight is the
  // integral of the bilinear interpolant over it, so that the density is positive wherever the
  // filtered picture is.
  LatLongDistribution(std::span<const float> brightness, int width, int height);

  [[nodiscard]] Sample sample(const Vec2& u) const;
  [[nodiscard]] float pdf(const Vec3& direction) const;
  // The mean brightness over the sphere.
  [[nodiscard]] double mean() const { return mean_; }

 private:
  [[nodiscard]] float density(int x, int y, float sin_theta) const;

  int width_ = 0, height_ = 0;
  double mean_ = 0;
  std::vector<float> row_cdf_;    // height + 1 entries
  std::vector<float> texel_cdf_;  // per row, width + 1 entries
};

}  // namespace pah
