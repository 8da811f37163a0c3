// Cameras, in scene coordinates (meters, double).
#pragma once

#include <optional>
#include <pah/geometry/vec.hpp>
#include <variant>

namespace pah {

// A pinhole, or a thin lens if aperture_radius > 0.
struct PerspectiveCamera {
  DVec3 position{0, 1, 5};
  DVec3 look_at{0, 0, 0};  // differs from position
  DVec3 up{0, 1, 0};       // not parallel to the viewing direction
  double fov = 45;         // vertical field of view, degrees, in (0, 180)
  double aperture_radius = 0;
  std::optional<double>
      focus_distance;  // along the viewing direction; |look_at - position| if unset
};

struct OrthographicCamera {
  DVec3 position{0, 1, 5};
  DVec3 look_at{0, 0, 0};
  DVec3 up{0, 1, 0};
  double height = 2;  // of the picture, meters, > 0
};

using Camera = std::variant<PerspectiveCamera, OrthographicCamera>;

}  // namespace pah
