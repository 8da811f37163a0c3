#include "report/study/rays.hpp"

#include <cmath>
#include <random>

namespace pah {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // Returns a number in [low, high). std::uniform_real_distribution differs between libraries.
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  DVec2 in_rectangle(const DVec2& half) {
    const double x = uniform(-half.x, half.x);
    return {x, uniform(-half.y, half.y)};
  }

 private:
  std::mt19937_64 engine_;
};

BundleRay draw(const PlaneArea& area, Random& random) {
  const Obb& box = area.box;
  const DVec2 at = random.in_rectangle(DVec2(box.half_size));
  return {box.center + box.axes * DVec3(at, -box.half_size.z), box.axes[2], 0, 2 * box.half_size.z};
}

BundleRay draw(const PointArea& area, Random& random) {
  const Frustum& frustum = area.frustum;
  for (;;) {
    const DVec2 at = random.in_rectangle(frustum.tan_half);
    // Solid angle per surface area of the plane at distance 1 is cos^3, at most 1.
    const double density = std::pow(1 + glm::dot(at, at), -1.5);
    if (area.measure == PointMeasure::solid_angle && random.uniform(0, 1) >= density) continue;
    return {frustum.eye, frustum.axes * DVec3(at, 1), frustum.near, frustum.far};
  }
}

}  // namespace

std::vector<BundleRay> draw_rays(const InfluenceArea& area, std::uint64_t count,
                                 std::uint64_t seed) {
  Random random(seed);
  std::vector<BundleRay> rays;
  rays.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i)
    rays.push_back(std::visit([&](const auto& a) { return draw(a, random); }, area));
  return rays;
}

Ray ray_of(const BundleRay& ray) {
  return {Vec3(ray.origin + ray.near * ray.direction), static_cast<float>(ray.far - ray.near),
          Vec3(ray.direction), no_bundle};
}

}  // namespace pah
