#include <algorithm>
#include <pah/influence/facing.hpp>
#include <utility>

namespace pah {

DVec3 facing_quality(const DVec3& v) {
  const DVec3 size = glm::abs(v);
  const double sum = size.x + size.y + size.z;
  return sum > 0 ? 1.0 - size / sum : DVec3(2.0 / 3);
}

std::array<int, 3> facing_axis_order(const DVec3& v) {
  const DVec3 size = glm::abs(v);
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](int axis) { return std::pair(size[axis], axis); });
  return order;
}

DVec3 mean_direction(const InfluenceArea& area, const Aabb& box) {
  return ray_direction(area, 0.5 * (DVec3(box.min) + DVec3(box.max)));
}

}  // namespace pah
