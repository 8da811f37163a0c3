// Tests light grids with adversarial shadow segments: through edges within a few last bits, in the
// planes of triangles, at the borders of cells and faces, from surfaces, and of all sizes.

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <pah/accel/light_grids.hpp>

#include "catch.hpp"
#include "geometry/ray_box.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr std::uint32_t bundle = 7;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::array<float, 4> tangents{0, 1e-6F, 0.005F, 0.3F};

Vec3 in_cube(Random& random) { return random.in_box({Vec3{-1}, Vec3{1}}); }
Vec3 unit_vector(Random& random) { return glm::normalize(in_cube(random) + Vec3{0, 0, 1e-3F}); }

// Moves each coordinate by at most two of its last bits.
Vec3 nudged(Vec3 p, Random& random) {
  for (int axis = 0; axis < 3; ++axis) {
    const int steps = static_cast<int>(random.below(5)) - 2;
    for (int step = 0; step < std::abs(steps); ++step)
      p[axis] = std::nextafter(p[axis], steps < 0 ? -infinity : infinity);
  }
  return p;
}

// Moves by one last bit along an axis: what lies across that axis is then certainly in front.
Vec3 just_behind(Vec3 p, const Vec3& direction) {
  const Vec3 size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  p[axis] = std::nextafter(p[axis], direction[axis] > 0 ? -infinity : infinity);
  return p;
}

// A multiple of a power of two in [-1, 1].
float dyadic(Random& random) {
  const std::uint32_t bits = random.below(11);
  return std::ldexp(static_cast<float>(random.below((2U << bits) + 1)), -static_cast<int>(bits)) -
         1;
}

// A point in the triangle's plane, possibly well outside of it.
Vec3 in_plane_of(const Triangle& t, Random& random) {
  return Vec3(DVec3(t.a) + double{random.uniform(-2, 3)} * (DVec3(t.b) - DVec3(t.a)) +
              double{random.uniform(-2, 3)} * (DVec3(t.c) - DVec3(t.a)));
}

Vec3 toward(const PointBundle& light, const Vec3& from, Random& /*random*/) {
  return light.eye - from;
}
Vec3 toward(const ParallelBundle& light, const Vec3& /*from*/, Random& random) {
  return light.tangent > 0 ? light.toward + light.tangent * in_cube(random) : light.toward;
}

Ray segment(const PointBundle& light, const Vec3& from, const Vec3& /*toward*/, Random& random) {
  constexpr std::array<float, 3> ends{1, 1 - 0x1p-24F, 1 - 0x1p-20F};
  return {from, ends[random.below(3)], light.eye - from, bundle};
}
Ray segment(const ParallelBundle& /*light*/, const Vec3& from, const Vec3& toward,
            Random& /*random*/) {
  return {from, infinity, toward, bundle};
}

// A point on a border of a point light's cells, or on a seam or corner of its faces; for suns, of
// world space.
Vec3 on_border(const PointBundle& light, float size, Random& random) {
  Vec3 away{1, dyadic(random), dyadic(random)};
  if (random.below(3) == 0) away.y = random.below(2) == 0 ? 1.0F : -1.0F;
  if (random.below(6) == 0) away.z = away.y;
  const int turn = static_cast<int>(random.below(3));
  away = {away[turn], away[(turn + 1) % 3], away[(turn + 2) % 3]};
  const float depth = size * std::ldexp(1.0F, -static_cast<int>(random.below(12)));
  return light.eye + (random.below(2) == 0 ? depth : -depth) * away;
}
Vec3 on_border(const ParallelBundle& /*light*/, float size, Random& random) {
  return size * Vec3{dyadic(random), dyadic(random), dyadic(random)};
}

// A place in the light's own plane, at depth 0.
Vec3 beside(const PointBundle& light, float size, Random& random) {
  Vec3 from = light.eye + size * in_cube(random);
  for (int i = 0; i < 2; ++i) {
    const auto axis = static_cast<int>(random.below(3));
    from[axis] = light.eye[axis];
  }
  return from;
}
Vec3 beside(const ParallelBundle& light, float size, Random& random) {
  const Vec3 any = in_cube(random);
  return size * (any - glm::dot(any, light.toward) * light.toward);
}

// Triangles, and one of them at which half of the rays aim.
struct Target {
  Triangles triangles;
  std::uint32_t aim = 0;
  float size = 1;

  [[nodiscard]] Triangle any(Random& random) const {
    const std::uint32_t i = random.below(static_cast<std::uint32_t>(triangles.size()));
    return triangles[random.below(2) == 0 ? aim : i];
  }
};

template <typename Bundle>
Ray adversarial_ray(const Bundle& light, const Target& target, Random& random) {
  const Triangle triangle = target.any(random);
  Vec3 from = point_on(triangle, random);
  Vec3 direction = toward(light, from, random);
  const auto behind = [&](float distance) {
    return Vec3(DVec3(from) - double{distance} * glm::normalize(DVec3(direction)));
  };
  switch (random.below(9)) {
    case 0:
      return segment(light, just_behind(from, direction), direction, random);
    case 1:
    case 2:
    case 3:
      from = behind(target.size * std::exp2(random.uniform(-26, 1)));
      break;
    case 4:
      from = behind(target.size * random.uniform(0, 1));
      break;
    case 5:
      from = in_plane_of(triangle, random);
      break;
    case 6:
      from = on_border(light, target.size, random);
      break;
    case 7:
      from = beside(light, target.size, random);
      break;
    default:
      break;
  }
  if (random.below(4) != 0) from = nudged(from, random);
  return segment(light, from, direction, random);
}

// The reference of a comparison, and its size.
class Trial {
 public:
  Trial(Soup soup, bool many, std::uint32_t seed)
      : soup_(std::move(soup)),
        expected_(many ? make_global_bvh(soup_.triangles()) : make_brute_force(soup_.triangles())),
        size_(largest_of(bounds_of(soup_.triangles()).extent())),
        random_(seed) {}

  // Compares points and suns of every kind. Returns the number of segments.
  std::size_t run(std::uint32_t rays_a_light) {
    const std::uint32_t triangles = static_cast<std::uint32_t>(soup_.indices.size());
    const std::uint32_t aim = random_.below(triangles);
    const Triangle triangle = soup_.triangles()[aim];
    const Vec3 at = point_on(triangle, random_);
    const std::size_t before = asked_;
    for (const Vec3& eye :
         {at, nudged(at, random_), nudged(in_plane_of(triangle, random_), random_)})
      check(PointBundle{eye}, aim, rays_a_light);
    for (const float distance : {1e-6F, 1.0F, 1e4F})
      check(PointBundle{at + size_ * distance * unit_vector(random_)}, aim, rays_a_light);
    const Vec3 away = unit_vector(random_);
    check(PointBundle{at + size_ * away, -away, 0.3F}, aim, rays_a_light);
    for (const float tangent : tangents) {
      check(ParallelBundle{unit_vector(random_), tangent}, aim, rays_a_light);
      check(ParallelBundle{axis(), tangent}, aim, rays_a_light);
      const DVec3 edge = DVec3(triangle.b) - DVec3(triangle.a);
      if (glm::length(edge) > 0)
        check(ParallelBundle{Vec3(glm::normalize(edge)), tangent}, aim, rays_a_light);
    }
    return asked_ - before;
  }

 private:
  Vec3 axis() {
    Vec3 along{0};
    along[static_cast<int>(random_.below(3))] = random_.below(2) == 0 ? 1.0F : -1.0F;
    return along;
  }

  template <typename Bundle>
  void check(const Bundle& light, std::uint32_t aim, std::uint32_t count) {
    const Target target{soup_.triangles(), aim, size_};
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i)
      rays.push_back(adversarial_ray(light, target, random_));
    std::vector<std::uint8_t> expected(count), found(count);
    expected_->occluded(rays, expected);
    make_light_grids(soup_.triangles(), {{bundle, light}})->occluded(rays, found);
    if (expected != found) {
      const auto wrong =
          static_cast<std::size_t>(std::ranges::mismatch(expected, found).in1 - expected.begin());
      UNSCOPED_INFO(soup_.name << ", triangle " << aim << ", a "
                               << (std::is_same_v<Bundle, PointBundle> ? "point" : "sun")
                               << ", ray " << wrong << " is occluded: " << int{expected[wrong]});
      FAIL_CHECK();
    }
    asked_ += count;
  }

  Soup soup_;
  std::unique_ptr<Accelerator> expected_;
  float size_;
  Random random_;
  std::size_t asked_ = 0;
};

// Needles, at most 1e-3 or 1e-6 of their length wide.
Soup slivers(std::uint32_t count, Random& random) {
  Soup soup{"slivers", {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 a = in_cube(random), b = in_cube(random);
    soup.add(a, b,
             random.uniform(0, 1) * (b - a) + a + (i % 2 == 0 ? 1e-3F : 1e-6F) * in_cube(random));
  }
  return soup;
}

Soup scaled(Soup soup, float scale) {
  for (Vec3& position : soup.positions) position *= scale;
  return soup;
}

// Triangles of sizes from 10^least to 10^most around one point.
Soup all_sizes(std::uint32_t count, float least, float most, Random& random) {
  Soup soup{"all sizes", {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const float size = std::pow(10.0F, random.uniform(least, most));
    soup.add(size * in_cube(random), size * in_cube(random), size * in_cube(random));
  }
  return soup;
}

// Triangles perpendicular to all axes, with corners at multiples of powers of two.
Soup dyadic_cards(std::uint32_t count, Random& random) {
  Soup soup{"dyadic cards", {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<Vec3, 3> corners;
    const auto across = static_cast<int>(random.below(3));
    const float level = dyadic(random);
    for (Vec3& corner : corners) {
      corner = {dyadic(random), dyadic(random), dyadic(random)};
      corner[across] = level;
    }
    soup.add(corners[0], corners[1], corners[2]);
  }
  return soup;
}

// Triangles of a few last bits, perpendicular to an axis and far from the center along the others:
// depths of suns are rounded by more than a last bit along that axis, and every point of a triangle
// is in front of an origin one last bit behind it. Each is repeated four times, so that no block
// holds two different ones: a block's depth is its least.
Soup last_bits(std::uint32_t count, Random& random) {
  Soup soup{"last bits", {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto across = static_cast<int>(random.below(3));
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = (random.below(2) == 0 ? 1.0F : -1.0F) * random.uniform(0.5F, 1);
    at[across] *= 0x1p-10F;
    Vec3 extent{0x1p-23F};
    extent[across] = 0;
    const Vec3 a = at + extent * in_cube(random);
    const Vec3 b = at + extent * in_cube(random);
    const Vec3 c = at + extent * in_cube(random);
    for (int copy = 0; copy < 4; ++copy) soup.add(a, b, c);
  }
  return soup;
}

// The light's view ends at the triangles' border: a ray beside them is outside of all cells. Thin
// ones get the largest number of cells.
Soup lone_triangle(Random& random) {
  Soup soup{"lone triangle", {}, {}};
  constexpr std::array<float, 4> widths{1, 1e-3F, 1e-6F, 0};
  Vec3 extent{1};
  for (int axis = 0; axis < 3; ++axis)
    if (random.below(2) == 0) extent[axis] = widths[random.below(4)];
  const Vec3 center = in_cube(random);
  soup.add(center + extent * in_cube(random), center + extent * in_cube(random),
           center + extent * in_cube(random));
  return soup;
}

std::vector<Soup> adversarial_soups(std::uint32_t count, std::uint32_t seed) {
  Random random(seed);
  const auto cells = static_cast<std::uint32_t>(std::sqrt(count / 2));
  std::vector<Soup> soups{slivers(count, random),
                          dyadic_cards(count, random),
                          last_bits(count, random),
                          all_sizes(count, -20, 20, random),
                          all_sizes(count, -4, 0, random),
                          grid(cells, 0.5F, seed),
                          grid(cells, 0, seed)};
  for (const float scale : {1e-20F, 1e20F})
    soups.push_back(scaled(random_soup(count, 0.1F, Vec3{0}, seed), scale));
  return soups;
}

}  // namespace

// Large scenes are compared with the BVH, which other tests compare with brute force.
TEST_CASE("Adversarial segments to a light are answered like brute force") {
  std::uint32_t seed = 1;
  std::size_t segments = 0;
  for (const Soup& soup : adversarial_soups(100, seed))
    segments += Trial(soup, false, ++seed).run(400);
  for (const Soup& soup : adversarial_soups(1000, seed))
    segments += Trial(soup, true, ++seed).run(300);
  Random random(2);
  for (int i = 0; i < 50; ++i) segments += Trial(lone_triangle(random), false, ++seed).run(100);
  for (int i = 0; i < 40; ++i) segments += Trial(last_bits(16, random), false, ++seed).run(700);
  CHECK(segments > 500'000);
}

TEST_CASE("1e8 adversarial segments, or 15 minutes of them, are answered like brute force",
          "[full]") {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::minutes(15);
  std::size_t segments = 0;
  Random random(3);
  for (std::uint32_t seed = 1000; segments < 100'000'000 && Clock::now() < end; seed += 1000) {
    for (const Soup& soup : adversarial_soups(100, seed))
      segments += Trial(soup, false, seed).run(5000);
    for (const Soup& soup : adversarial_soups(10'000, seed))
      segments += Trial(soup, true, seed).run(20'000);
    for (int i = 0; i < 100; ++i) {
      segments += Trial(lone_triangle(random), false, random.below(1U << 31U)).run(500);
      segments += Trial(last_bits(16, random), false, random.below(1U << 31U)).run(2000);
    }
  }
  WARN(segments << " segments");
  CHECK(segments > 1'000'000);
}
