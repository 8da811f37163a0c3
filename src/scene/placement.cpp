#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <pah/geometry/basis.hpp>
#include <pah/scene/placement.hpp>
#include <stdexcept>
#include <unordered_map>

#include "base/mix_bits.hpp"
#include "geometry/normal.hpp"

namespace pah {
namespace {

bool finite(const DVec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

// Returns a uniform number in [0, 1) that depends on its arguments alone: a counter hashed by the
// finalizer of SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
// 2014).
double random_number(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
  const auto mix = [](std::uint64_t z) { return mix_bits(z + 0x9E3779B97F4A7C15ULL); };
  return static_cast<double>(mix(mix(mix(seed) ^ index) ^ dimension) >> 11) * 0x1p-53;
}

// The uses of random numbers in a copy.
enum Draw : std::uint64_t { draw_triangle, draw_u, draw_v, draw_angle, draw_scale };

glm::dmat4x3 translation(const DVec3& t) { return {DVec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t}; }

glm::dmat4x3 rotation_about_y(double radians) {
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  return {DVec3{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0, 0, 0}};
}

// Returns a rotation that takes +y to the unit vector n: a basis about n with permuted axes.
glm::dmat4x3 rotation_to(const DVec3& n) {
  const DMat3 basis = basis_about(DVec3(n.z, n.x, n.y));
  const auto permuted = [](const DVec3& v) { return DVec3(v.y, v.z, v.x); };
  return {permuted(basis[1]), n, permuted(basis[0]), {0, 0, 0}};
}

glm::dmat4x3 scaling(double s) { return {DVec3{s, 0, 0}, {0, s, 0}, {0, 0, s}, {0, 0, 0}}; }

std::vector<glm::dmat4x3> place_copies(const LineRepeat& line) {
  require(finite(line.step), "step must be finite");
  std::vector<glm::dmat4x3> copies;
  copies.reserve(line.count);
  for (std::uint32_t i = 0; i < line.count; ++i)
    copies.push_back(translation(static_cast<double>(i) * line.step));
  return copies;
}

std::vector<glm::dmat4x3> place_copies(const GridRepeat& grid) {
  require(finite(grid.step), "step must be finite");
  const DVec3 first = grid.centered ? -0.5 * DVec3(grid.count - 1U) * grid.step : DVec3{0};
  std::vector<glm::dmat4x3> copies;
  copies.reserve(count_of(grid));
  for (std::uint32_t z = 0; z < grid.count.z; ++z)
    for (std::uint32_t y = 0; y < grid.count.y; ++y)
      for (std::uint32_t x = 0; x < grid.count.x; ++x)
        copies.push_back(translation(first + DVec3(x, y, z) * grid.step));
  return copies;
}

std::vector<glm::dmat4x3> place_copies(const RingRepeat& ring) {
  require(std::isfinite(ring.radius) && std::isfinite(ring.start),
          "radius and start must be finite");
  std::vector<glm::dmat4x3> copies;
  copies.reserve(ring.count);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    const double degrees = ring.start + 360.0 * i / ring.count;
    const glm::dmat4x3 turn = rotation_about_y(degrees * (std::numbers::pi / 180));
    const DVec3 position = ring.radius * turn[0];
    copies.push_back(ring.turn ? compose(translation(position), turn) : translation(position));
  }
  return copies;
}

// Accepts points that keep the minimum distance from all points accepted before.
class Spacing {
 public:
  // `extent` is the largest size of the region of the points. Cells are at least 2^-20 of it, so
  // that cell numbers stay small.
  Spacing(double distance, double extent)
      : distance_(distance), cell_(std::max(distance, extent * 0x1p-20)) {}

  bool accept(const DVec3& point) {
    const Cell home{std::floor(point.x / cell_), std::floor(point.y / cell_),
                    std::floor(point.z / cell_)};
    for (int i = 0; i < 27; ++i) {
      const int x = i % 3 - 1;
      const int y = i / 3 % 3 - 1;
      const int z = i / 9 - 1;
      const Cell cell{home[0] + x, home[1] + y, home[2] + z};
      const auto [first, last] = points_.equal_range(cell);
      for (auto it = first; it != last; ++it)
        if (glm::distance(it->second, point) < distance_) return false;
    }
    points_.emplace(home, point);
    return true;
  }

 private:
  using Cell = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::size_t h = 0;
      for (const double x : cell) h = (h ^ std::hash<double>{}(x)) * 0x9E3779B97F4A7C15ULL;
      return h;
    }
  };
  double distance_;
  double cell_;
  std::unordered_multimap<Cell, DVec3, Hash> points_;
};

struct ScatterPoint {
  DVec3 position;
  DVec3 normal;
};

// `sample(i)` returns the i-th random point of the surface. With a minimum distance, draws
// candidates until `count` are placed, but at most 30 per copy.
template <class Sample>
std::vector<glm::dmat4x3> scatter_points(const ScatterOptions& options, double extent,
                                         const Sample& sample) {
  require(options.count > 0, "count must be at least 1");
  require(
      options.scale.x > 0 && options.scale.y >= options.scale.x && std::isfinite(options.scale.y),
      "scale must be two factors 0 < low <= high");
  require(options.min_distance >= 0 && std::isfinite(options.min_distance),
          "min_distance must be a length >= 0");
  constexpr std::uint64_t tries = 30;
  const bool spaced = options.min_distance > 0;
  const std::uint64_t candidates = spaced ? tries * options.count : options.count;
  Spacing spacing(options.min_distance, extent);
  std::vector<glm::dmat4x3> copies;
  for (std::uint64_t i = 0; i < candidates && copies.size() < options.count; ++i) {
    const ScatterPoint point = sample(i);
    if (spaced && !spacing.accept(point.position)) continue;
    glm::dmat4x3 copy = translation(point.position);
    if (options.align) copy = compose(copy, rotation_to(point.normal));
    if (options.turn)
      copy = compose(copy, rotation_about_y(2 * std::numbers::pi *
                                            random_number(options.seed, i, draw_angle)));
    const double u = random_number(options.seed, i, draw_scale);
    copies.push_back(
        compose(copy, scaling(options.scale.x + u * (options.scale.y - options.scale.x))));
  }
  return copies;
}

}  // namespace

glm::dmat4x3 compose(const glm::dmat4x3& c_from_b, const glm::dmat4x3& b_from_a) {
  const DMat3 linear(c_from_b);
  return {linear * b_from_a[0], linear * b_from_a[1], linear * b_from_a[2],
          linear * b_from_a[3] + c_from_b[3]};
}

std::uint64_t count_of(const Repeat& repeat) {
  if (const auto* grid = std::get_if<GridRepeat>(&repeat)) {
    // Saturates: the product of three 32-bit numbers may not fit.
    const std::uint64_t layer = std::uint64_t{grid->count.x} * grid->count.y;
    if (grid->count.z != 0 && layer > UINT64_MAX / grid->count.z) return UINT64_MAX;
    return layer * grid->count.z;
  }
  if (const auto* line = std::get_if<LineRepeat>(&repeat)) return line->count;
  return std::get<RingRepeat>(repeat).count;
}

std::vector<glm::dmat4x3> place(const Repeat& repeat) {
  require(count_of(repeat) > 0, "count must be at least 1");
  return std::visit([](const auto& r) { return place_copies(r); }, repeat);
}

std::vector<glm::dmat4x3> scatter(const DVec2& size, const ScatterOptions& options) {
  require(size.x >= 0 && size.y >= 0 && std::isfinite(size.x) && std::isfinite(size.y),
          "size must be two lengths >= 0");
  return scatter_points(options, std::max(size.x, size.y), [&](std::uint64_t i) {
    return ScatterPoint{{(random_number(options.seed, i, draw_u) - 0.5) * size.x, 0,
                         (random_number(options.seed, i, draw_v) - 0.5) * size.y},
                        {0, 1, 0}};
  });
}

std::vector<glm::dmat4x3> scatter(const Mesh& mesh, const glm::dmat4x3& world_from_object,
                                  const ScatterOptions& options) {
  const auto corner = [&](std::uint32_t vertex) {
    return world_from_object * glm::dvec4(DVec3(mesh.positions[vertex]), 1);
  };
  // Mirroring flips the computed normals.
  const double side = std::copysign(1.0, glm::determinant(DMat3(world_from_object)));
  DVec3 low{HUGE_VAL};
  DVec3 high{-HUGE_VAL};
  std::vector<double> running;  // surface area up to and including each triangle
  running.reserve(mesh.triangles.size());
  double total = 0;
  for (const UVec3& t : mesh.triangles) {
    const DVec3 a = corner(t.x);
    const DVec3 b = corner(t.y);
    const DVec3 c = corner(t.z);
    total += glm::length(scaled_normal(a, b, c));
    running.push_back(total);
    low = glm::min(low, glm::min(a, glm::min(b, c)));
    high = glm::max(high, glm::max(a, glm::max(b, c)));
  }
  require(total > 0 && std::isfinite(total), "the mesh to scatter over has no surface area");
  const DVec3 extent = high - low;
  return scatter_points(
      options, std::max(extent.x, std::max(extent.y, extent.z)), [&](std::uint64_t i) {
        // The first triangle whose running total exceeds the draw never has surface area 0.
        const double draw = random_number(options.seed, i, draw_triangle) * total;
        const auto at =
            std::upper_bound(running.begin(), running.end() - 1, draw) - running.begin();
        const UVec3& t = mesh.triangles[static_cast<std::size_t>(at)];
        const DVec3 a = corner(t.x);
        const DVec3 b = corner(t.y);
        const DVec3 c = corner(t.z);
        const double root = std::sqrt(random_number(options.seed, i, draw_u));
        const double v = root * random_number(options.seed, i, draw_v);
        const DVec3 normal = scaled_normal(a, b, c);
        const double length = glm::length(normal);
        return ScatterPoint{(1 - root) * a + (root - v) * b + v * c,
                            length > 0 ? side * normal / length : DVec3{0, 1, 0}};
      });
}

}  // namespace pah
