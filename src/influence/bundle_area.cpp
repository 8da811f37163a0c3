#include <cmath>
#include <pah/influence/bundle_area.hpp>

namespace pah {

DVec3 mean_absolute_direction(const InfluenceArea& area) {
  if (const auto* plane = std::get_if<PlaneArea>(&area)) return glm::abs(plane->box.axes[2]);
  const auto& [frustum, measure] = std::get<PointArea>(area);
  constexpr int steps = 64;
  DVec3 sum(0);
  double weights = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const DVec2 place = frustum.tan_half * (DVec2(2 * i + 1, 2 * j + 1) / double{steps} - 1.0);
      const DVec3 ray = frustum.axes * DVec3(place, 1);
      const double length = glm::length(ray);
      // The solid angle of a cell of the picture plane, up to a constant.
      const double weight =
          measure == PointMeasure::solid_angle ? 1 / (length * length * length) : 1;
      sum += weight / length * glm::abs(ray);
      weights += weight;
    }
  return sum / weights;
}

}  // namespace pah
