#include "render/light/lat_long.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pah {
namespace {

using std::numbers::pi_v;

// Fills cdf[0..n] from n weights and returns their sum; uniform if they are all zero.
double fill_cdf(std::span<const double> weights, std::span<float> cdf) {
  double sum = 0;
  for (const double w : weights) sum += w;
  double running = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    cdf[i] = static_cast<float>(
        sum > 0 ? running / sum : static_cast<double>(i) / static_cast<double>(weights.size()));
    running += weights[i];
  }
  cdf[weights.size()] = 1;
  return sum;
}

// The last i with cdf[i] <= u and a cell of positive width; u becomes the place within the cell.
int find_cell(std::span<const float> cdf, float& u) {
  const auto above = std::upper_bound(cdf.begin(), cdf.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - cdf.begin()) - 1;
  u = std::min((u - cdf[i]) / (cdf[i + 1] - cdf[i]), 0x1.fffffep-1F);
  return static_cast<int>(i);
}

}  // namespace

Vec2 lat_long_from_direction(const Vec3& d) {
  const float horizontal = std::sqrt(d.x * d.x + d.z * d.z);
  return {0.5F + std::atan2(d.x, -d.z) / (2 * pi_v<float>),
          std::atan2(horizontal, d.y) / pi_v<float>};
}

Vec3 direction_from_lat_long(const Vec2& uv) {
  const float phi = (uv.x - 0.5F) * 2 * pi_v<float>;
  const float theta = uv.y * pi_v<float>;
  const float sin_theta = std::sin(theta);
  return {sin_theta * std::sin(phi), std::cos(theta), -sin_theta * std::cos(phi)};
}

LatLongDistribution::LatLongDistribution(std::span<const float> brightness, int width, int height)
    : width_(width), height_(height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  // Bilinear interpolation between texel centers, integrated over one texel: 1/8, 6/8, 1/8.
  const auto filtered_row = [&](std::size_t x, std::size_t y) {
    const float* row = brightness.data() + y * w;
    return 0.125 * static_cast<double>(row[(x + w - 1) % w]) + 0.75 * static_cast<double>(row[x]) +
           0.125 * static_cast<double>(row[(x + 1) % w]);
  };
  row_cdf_.resize(h + 1);
  texel_cdf_.resize(h * (w + 1));
  std::vector<double> weights(w), rows(h);
  double sin_sum = 0;
  for (std::size_t y = 0; y < h; ++y) {
    const std::size_t above = y > 0 ? y - 1 : 0, below = std::min(y + 1, h - 1);
    for (std::size_t x = 0; x < w; ++x) {
      weights[x] = 0.125 * filtered_row(x, above) + 0.75 * filtered_row(x, y) +
                   0.125 * filtered_row(x, below);
    }
    const double sin_theta =
        std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(h));
    rows[y] = fill_cdf(weights, std::span(texel_cdf_).subspan(y * (w + 1), w + 1)) * sin_theta;
    sin_sum += sin_theta;
  }
  mean_ = fill_cdf(rows, row_cdf_) / (sin_sum * static_cast<double>(w));
}

float LatLongDistribution::density(int x, int y, float sin_theta) const {
  const auto row = static_cast<std::size_t>(y), column = static_cast<std::size_t>(x);
  const float* texels = texel_cdf_.data() + row * (static_cast<std::size_t>(width_) + 1);
  const float in_row = (row_cdf_[row + 1] - row_cdf_[row]) * static_cast<float>(height_);
  const float in_texel = (texels[column + 1] - texels[column]) * static_cast<float>(width_);
  return sin_theta > 0 ? in_row * in_texel / (2 * pi_v<float> * pi_v<float> * sin_theta) : 0;
}

LatLongDistribution::Sample LatLongDistribution::sample(const Vec2& u) const {
  float u0 = u.x, u1 = u.y;
  const int y = find_cell(row_cdf_, u1);
  const auto stride = static_cast<std::size_t>(width_) + 1;
  const int x =
      find_cell(std::span(texel_cdf_).subspan(static_cast<std::size_t>(y) * stride, stride), u0);
  const Vec2 uv((static_cast<float>(x) + u0) / static_cast<float>(width_),
                (static_cast<float>(y) + u1) / static_cast<float>(height_));
  const Vec3 direction = direction_from_lat_long(uv);
  const float sin_theta = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return {direction, density(x, y, sin_theta)};
}

float LatLongDistribution::pdf(const Vec3& direction) const {
  const Vec2 uv = lat_long_from_direction(direction);
  const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(width_)), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(height_)), 0, height_ - 1);
  return density(x, y, std::sqrt(direction.x * direction.x + direction.z * direction.z));
}

}  // namespace pah
