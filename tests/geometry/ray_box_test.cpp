// Compares the slab test with exact integer arithmetic.
#include "geometry/ray_box.hpp"

#include <algorithm>
#include <array>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

struct IntegerCase {
  std::array<std::int64_t, 3> origin, direction, low, high;
};

// Small numbers are frequent, so that rays hit faces, edges and zeros exactly.
IntegerCase random_case(test::Random& random) {
  IntegerCase c{};
  const std::uint32_t range = random.below(2) == 0 ? 4 : 1U << 16U;
  const auto integer = [&] {
    return std::int64_t{random.below(2 * range + 1)} - std::int64_t{range};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    c.origin[i] = integer();
    c.direction[i] = random.below(4) == 0 ? 0 : integer();
    const std::int64_t a = integer();
    const std::int64_t b = random.below(4) == 0 ? a : integer();
    c.low[i] = std::min(a, b);
    c.high[i] = std::max(a, b);
  }
  return c;
}

struct Fraction {
  std::int64_t over, under;  // under > 0
  friend bool operator<(const Fraction& a, const Fraction& b) {
    return a.over * b.under < b.over * a.under;
  }
};

// Whether origin + t * direction is in the closed box for some t >= 0, exactly; `margin` widens the
// box.
bool exact_hit(const IntegerCase& c, std::int64_t margin) {
  Fraction near{0, 1};
  Fraction far{std::int64_t{1} << 40U, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t low = c.low[i] - c.origin[i] - margin;
    std::int64_t high = c.high[i] - c.origin[i] + margin;
    std::int64_t under = c.direction[i];
    if (under == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    if (under < 0) {
      std::swap(low, high);
      low = -low;
      high = -high;
      under = -under;
    }
    near = std::max(near, Fraction{low, under});
    far = std::min(far, Fraction{high, under});
  }
  return !(far < near);
}

void compare(std::uint32_t count) {
  test::Random random(11);
  std::uint32_t hits = 0;
  std::uint32_t false_misses = 0;
  std::uint32_t false_hits = 0;
  std::uint32_t asked = 0;
  while (asked < count) {
    const IntegerCase c = random_case(random);
    if (c.direction == std::array<std::int64_t, 3>{0, 0, 0}) continue;
    ++asked;
    const float scale = std::ldexp(1.0F, static_cast<int>(random.below(81)) - 40);
    const float direction_scale = std::ldexp(1.0F, static_cast<int>(random.below(81)) - 40);
    Ray ray;
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const float zero = random.below(2) == 0 ? 1.0F : -1.0F;  // both zeros
      ray.origin[i] = scale * static_cast<float>(c.origin[k]);
      ray.direction[i] = c.direction[k] == 0 ? std::copysign(0.0F, zero)
                                             : direction_scale * static_cast<float>(c.direction[k]);
      box.min[i] = scale * static_cast<float>(c.low[k]);
      box.max[i] = scale * static_cast<float>(c.high[k]);
    }
    const SlabInterval interval = intersect_box(prepare(ray), padded(box));
    const bool found = interval.near <= interval.far;
    if (exact_hit(c, 0)) {
      ++hits;
      false_misses += found ? 0 : 1;
    } else if (found && !exact_hit(c, 1)) {
      ++false_hits;  // misses by a whole unit in coordinates of at most 2^17
    }
  }
  CHECK(hits > count / 20);
  CHECK(false_misses == 0);
  CHECK(false_hits == 0);
}

}  // namespace

TEST_CASE("The slab test misses no box that exact arithmetic hits") { compare(1000000); }
TEST_CASE("The slab test misses no box that exact arithmetic hits, 1e7 rays", "[full]") {
  compare(10000000);
}

TEST_CASE("The interval of a box contains that of a box inside it, to the last bit") {
  test::Random random(12);
  std::uint32_t both = 0;
  std::uint32_t violations = 0;
  for (int i = 0; i < 300000; ++i) {
    Aabb inner;
    inner.extend(random.in_box({Vec3{-1}, Vec3{1}}));
    inner.extend(random.in_box({Vec3{-1}, Vec3{1}}));
    Aabb outer = inner;
    if (random.below(2) == 0) outer.extend(random.in_box({Vec3{-2}, Vec3{2}}));
    Ray ray{random.in_box({Vec3{-2}, Vec3{2}}), 1e30F, random.in_box({Vec3{-1}, Vec3{1}}), 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (random.below(4) == 0) ray.direction[axis] = 0;
      if (random.below(4) == 0) ray.origin[axis] = inner.min[axis];
    }
    const PreparedRay prepared = prepare(ray);
    const SlabInterval in = intersect_box(prepared, padded(inner));
    const SlabInterval out = intersect_box(prepared, padded(outer));
    if (in.near <= in.far) {
      ++both;
      violations += out.near <= in.near && out.far >= in.far ? 0 : 1;
    }
  }
  CHECK(both > 10000);
  CHECK(violations == 0);
}
