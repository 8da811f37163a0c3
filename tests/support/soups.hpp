// Triangles and rays for the comparison of accelerators.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <random>
#include <string>
#include <vector>

namespace pah::test {

struct Soup {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<UVec3> indices;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    indices.emplace_back(first, first + 1, first + 2);
  }
  [[nodiscard]] Triangles triangles() const { return {positions, indices}; }
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  // In [low, high).
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(engine_() >> 8U) * 0x1p-24F;
  }
  Vec3 in_box(const Aabb& box) {
    return {uniform(box.min.x, box.max.x), uniform(box.min.y, box.max.y),
            uniform(box.min.z, box.max.z)};
  }
  std::uint32_t below(std::uint32_t n) { return engine_() % n; }

 private:
  std::mt19937 engine_;
};

// Returns a point of a triangle: inside, on an edge, or a vertex.
inline Vec3 point_on(const Triangle& t, Random& random) {
  float u = random.uniform(0, 1), v = random.uniform(0, 1) * (1 - u);
  switch (random.below(4)) {
    case 0:
      v = 0;
      break;
    case 1:
      u = 1 - v;
      break;
    case 2:
      u = v = 0;
      break;
    default:
      break;
  }
  return (1 - u - v) * t.a + u * t.b + v * t.c;
}

inline Soup random_soup(std::uint32_t count, float size, const Vec3& center, std::uint32_t seed) {
  Soup soup;
  soup.name = "random soup";
  Random random(seed);
  const Aabb around{Vec3{-1}, Vec3{1}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 at = center + random.in_box(around);
    soup.add(at + size * random.in_box(around), at + size * random.in_box(around),
             at + size * random.in_box(around));
  }
  return soup;
}

// Returns a height field with shared vertices; flat if `height` is 0.
inline Soup grid(std::uint32_t cells, float height, std::uint32_t seed) {
  Soup soup;
  soup.name = height == 0 ? "flat grid" : "height field";
  Random random(seed);
  for (std::uint32_t y = 0; y <= cells; ++y) {
    for (std::uint32_t x = 0; x <= cells; ++x) {
      soup.positions.emplace_back(static_cast<float>(x), height * random.uniform(0, 1),
                                  static_cast<float>(y));
    }
  }
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t i = y * (cells + 1) + x;
      soup.indices.emplace_back(i, i + 1, i + cells + 1);
      soup.indices.emplace_back(i + 1, i + cells + 2, i + cells + 1);
    }
  }
  return soup;
}

inline std::vector<Soup> all_soups() {
  std::vector<Soup> soups;
  soups.push_back({"empty", {}, {}});
  soups.push_back(random_soup(1, 0.7F, Vec3{0}, 1));
  soups.back().name = "one triangle";
  soups.push_back(random_soup(2, 0.7F, Vec3{0}, 2));
  soups.back().name = "two triangles";
  soups.push_back(random_soup(2000, 0.1F, Vec3{0}, 3));
  soups.push_back(random_soup(2000, 1e-3F, Vec3{1e3F, -1e3F, 1e3F}, 4));
  soups.back().name = "far from the origin";
  soups.push_back(random_soup(300, 2.0F, Vec3{0}, 5));
  soups.back().name = "overlapping";
  soups.push_back(grid(24, 1.0F, 6));
  soups.push_back(grid(24, 0.0F, 7));

  Soup identical{"identical", {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, {}};
  identical.indices.assign(300, UVec3{0, 1, 2});
  soups.push_back(identical);

  Soup stadium = random_soup(1000, 0.01F, Vec3{0}, 8);
  stadium.name = "huge among tiny";
  stadium.add({-1e4F, -1, -1e4F}, {1e4F, -1, -1e4F}, {0, -1, 1e4F});
  stadium.add({-1e4F, -1e4F, 1e4F}, {1e4F, -1e4F, 1e4F}, {0, 1e4F, 1e4F});
  soups.push_back(stadium);

  Soup degenerate{"degenerate", {}, {}};
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random.in_box({Vec3{-1}, Vec3{1}});
    const Vec3 b = random.in_box({Vec3{-1}, Vec3{1}});
    degenerate.add(a, b, i % 2 == 0 ? a : 0.5F * (a + b));
    degenerate.add(a, b, b + 1e-6F * random.in_box({Vec3{-1}, Vec3{1}}));
  }
  soups.push_back(degenerate);
  return soups;
}

// Rays of all kinds: through points of triangles (vertices and edges among them), axis-parallel,
// from surfaces, short and endless.
inline std::vector<Ray> rays_for(const Soup& soup, std::uint32_t count, std::uint32_t seed) {
  Random random(seed);
  Aabb box = bounds_of(soup.triangles());
  if (box.empty()) box = {Vec3{-1}, Vec3{1}};
  const Vec3 size = glm::max(box.extent(), Vec3{1e-3F});
  const Aabb around{box.min - size, box.max + size};
  const auto surface_point = [&] {
    if (soup.indices.empty()) return random.in_box(box);
    const Triangle triangle =
        soup.triangles()[random.below(static_cast<std::uint32_t>(soup.indices.size()))];
    switch (random.below(3)) {
      case 0:
        return triangle.a;
      case 1:
        return 0.5F * triangle.a + 0.5F * triangle.b;
      default: {
        const float u = random.uniform(0, 1);
        const float v = random.uniform(0, 1 - u);
        return triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
      }
    }
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    Ray ray;
    const std::uint32_t kind = random.below(6);
    ray.origin = kind == 0 ? surface_point() : random.in_box(around);
    ray.direction = surface_point() - ray.origin;
    if (kind == 1) {
      const auto axis = static_cast<int>(random.below(3));
      const Vec3 target = surface_point();
      ray.origin = target;
      ray.origin[axis] = around.min[axis];
      ray.direction = Vec3{random.below(2) == 0 ? 0.0F : -0.0F};
      ray.direction[axis] = random.below(2) == 0 ? 1.0F : -1.0F;
    }
    if (kind == 2) ray.t_max = random.uniform(0, 2);
    if (kind == 3) ray.t_max = 1;
    if (kind == 4) ray.direction = random.in_box({Vec3{-1}, Vec3{1}});
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace pah::test
