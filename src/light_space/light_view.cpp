#include "light_space/light_view.hpp"

#include <cmath>
#include <numbers>

namespace pah {

// In the plane of the tangent's axis and the face's axis, the cone's directions are those within
// asin(sine / length of the cone axis's projection) of that projection. Directions that rounding
// excludes have no place on the face: their rays traverse the BVH.
Interval CubeView::limits(int face, int axis) const {
  // Tangents of the face's border, rounded.
  constexpr double border = 1 + 0x1p-20;
  if (!is_cone()) return {-border, border};
  constexpr double right_angle = std::numbers::pi / 2;
  const int z = face % 3;
  const double along = face < 3 ? axis_[z] : -axis_[z];
  const double across = axis_[(z + 1 + axis) % 3];
  const double length = std::hypot(along, across);
  if (!(sine_ < length)) return {-border, border};
  const double middle = std::atan2(across, along);
  const double half = std::asin(sine_ / length);
  if (std::abs(middle) >= right_angle + half) return {};
  return common({-border, border},
                {middle - half <= -right_angle ? -border : std::tan(middle - half),
                 middle + half >= right_angle ? border : std::tan(middle + half)});
}

}  // namespace pah
