#include "render/surface/shading_frame.hpp"

#include <cmath>

namespace pah {

ShadingFrame make_frame(const Vec3& normal, const Vec3& tangent) {
  const float length = glm::length(tangent);
  if (!(length > 0) || !std::isfinite(length)) return make_frame(normal);
  const Vec3 t = tangent / length;
  const Vec3 x = t - normal * glm::dot(normal, t);
  // x carries the rounding of the two products, about 2^-23 in length; where that is more than
  // 2^-10 of it, its direction is noise.
  const float x_length = glm::length(x);
  if (!(x_length > 0x1p-13F)) return make_frame(normal);
  ShadingFrame frame{x / x_length, {}, normal};
  frame.y = glm::cross(frame.z, frame.x);
  return frame;
}

}  // namespace pah
