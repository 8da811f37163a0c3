#include "report/study/areas.hpp"

#include <cmath>
#include <numbers>

namespace pah {

const char* name_of(StudyGroup group) {
  switch (group) {
    case StudyGroup::plane_axis:
      return "plane, along an axis";
    case StudyGroup::plane_15:
      return "plane, 15 degrees off";
    case StudyGroup::plane_45:
      return "plane, 45 degrees off";
    case StudyGroup::plane_oblique:
      return "plane, oblique";
    case StudyGroup::point_outside:
      return "point, outside";
    case StudyGroup::point_inside:
      return "point, inside";
  }
  return "";
}

std::vector<StudyArea> study_areas(const Aabb& bounds, bool quick) {
  const DVec3 center = 0.5 * DVec3(bounds.min) + 0.5 * DVec3(bounds.max);
  const double radius = 0.5 * glm::length(DVec3(bounds.max) - DVec3(bounds.min));
  const double width = radius;  // of a cross-section at the mesh's center

  const auto off_axis = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return DVec3(std::sin(angle), -std::cos(angle), 0);
  };
  const DVec3 oblique = glm::normalize(DVec3(1, -1.1, 0.9));
  std::vector<StudyArea> areas;
  const auto add_plane = [&](const char* name, StudyGroup group, const DVec3& direction) {
    areas.push_back({name, group,
                     make_plane_area(center - radius * glm::normalize(direction), direction,
                                     DVec2(width), 2 * radius)});
  };
  // `distance` of the eye from the center, in radii.
  const auto add_point = [&](const char* name, double distance, const DVec3& direction) {
    const double fov = 2 * std::atan2(0.5 * width, distance * radius);
    areas.push_back({name, StudyGroup::point_outside,
                     make_point_area(center - distance * radius * direction, direction, DVec2(fov),
                                     0, (distance + 1) * radius)});
  };
  const auto add_inside = [&](const char* name, const DVec3& direction) {
    areas.push_back({name, StudyGroup::point_inside,
                     make_point_area(center, direction, DVec2(0.5 * std::numbers::pi), 0, radius)});
  };

  add_plane("plane y", StudyGroup::plane_axis, {0, -1, 0});
  if (!quick) {
    add_plane("plane x", StudyGroup::plane_axis, {-1, 0, 0});
    add_plane("plane z", StudyGroup::plane_axis, {0, 0, -1});
  }
  add_plane("plane 15", StudyGroup::plane_15, off_axis(15));
  add_plane("plane 45", StudyGroup::plane_45, off_axis(45));
  add_plane("plane oblique", StudyGroup::plane_oblique, oblique);
  add_point("point near, oblique", 1.25, oblique);
  if (!quick) {
    add_point("point near, axis", 1.25, {0, -1, 0});
    add_point("point far, axis", 5, {0, -1, 0});
    add_point("point far, oblique", 5, oblique);
    add_inside("point inside, axis", {0, -1, 0});
  }
  add_inside("point inside, oblique", oblique);
  return areas;
}

}  // namespace pah
