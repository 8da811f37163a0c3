#include "render/sampling/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pah {
namespace {

using std::numbers::pi_v;

Vec3 from_height(float z, float sin_theta, float u) {
  const float phi = 2 * pi_v<float> * u;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), z};
}

// The Blackman-Harris window on [-1, 1], taken as linear between equidistant knots. The knots'
// trapezoidal sum is the window's integral exactly, since it is a sum of four cosines.
constexpr int intervals = 256;
constexpr double a0 = 0.35875, a1 = 0.48829, a2 = 0.14128, a3 = 0.01168;

// Where to look for a number's interval: at the first one of its cell.
constexpr int cells = 1024;

struct Window {
  std::array<float, intervals + 1> density;  // at the knots
  std::array<float, intervals + 1> cdf;
  std::array<std::uint16_t, cells> first;
};

Window make_window() {
  Window window{};
  double sum = 0, previous = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double x = std::numbers::pi * (2.0 * i / intervals - 1);
    const double value = a0 + a1 * std::cos(x) + a2 * std::cos(2 * x) + a3 * std::cos(3 * x);
    const double density = value / (2 * a0);
    if (i > 0) sum += (previous + density) / intervals;
    previous = density;
    window.density[static_cast<std::size_t>(i)] = static_cast<float>(density);
    window.cdf[static_cast<std::size_t>(i)] = static_cast<float>(sum);
  }
  std::uint16_t interval = 0;
  for (int cell = 0; cell < cells; ++cell) {
    const float u = static_cast<float>(cell) / cells;
    while (interval + 1 < intervals && window.cdf[interval + 1U] <= u) ++interval;
    window.first[static_cast<std::size_t>(cell)] = interval;
  }
  return window;
}

const Window window = make_window();

float sample_window(float u) {
  std::size_t i = window.first[static_cast<std::size_t>(u * cells)];
  while (i + 1 < intervals && window.cdf[i + 1] <= u) ++i;
  // Inverts a t + (b - a) t^2 / 2 = c, in the form that does not cancel.
  const float a = window.density[i];
  const float b = window.density[i + 1];
  const float c = (u - window.cdf[i]) * (intervals / 2.0F);
  const float root = std::sqrt(std::max(0.0F, a * a + 2 * (b - a) * c));
  const float t = c > 0 ? std::min(1.0F, 2 * c / (a + root)) : 0.0F;
  return (static_cast<float>(i) + t) * (2.0F / intervals) - 1;
}

}  // namespace

Vec3 sample_uniform_sphere(Vec2 u) { return sample_uniform_cone(u, 2); }

float pdf_uniform_sphere() { return 1 / (4 * pi_v<float>); }

Vec3 sample_uniform_cone(Vec2 u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;
  return from_height(1 - h, std::sqrt(h * (2 - h)), u.y);
}

float pdf_uniform_cone(float one_minus_cos) { return 1 / (2 * pi_v<float> * one_minus_cos); }

Vec2 sample_uniform_triangle(Vec2 u) {
  const float root = std::sqrt(u.x);
  return {root * (1 - u.y), root * u.y};
}

Vec2 sample_blackman_harris(Vec2 u, float radius) {
  return radius * Vec2{sample_window(u.x), sample_window(u.y)};
}

Vec2 sample_box(Vec2 u, float radius) { return radius * (2.0F * u - 1.0F); }

}  // namespace pah
