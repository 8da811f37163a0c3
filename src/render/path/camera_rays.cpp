#include "render/path/camera_rays.hpp"

#include <cmath>

#include "render/sampling/warp.hpp"

namespace pah {

CameraRays::CameraRays(const Camera& camera, const FilmSettings& film)
    : filter_(film.filter),
      filter_radius_(static_cast<float>(film.filter_radius)),
      width_(static_cast<float>(film.width)),
      height_(static_cast<float>(film.height)) {
  double half_height = 1;
  const auto look = [this](const auto& any) {
    const DVec3 forward = glm::normalize(any.look_at - any.position);
    const DVec3 right = glm::normalize(glm::cross(forward, any.up));
    position_ = Vec3(any.position);
    forward_ = Vec3(forward);
    right_ = Vec3(right);
    up_ = Vec3(glm::cross(right, forward));
  };
  std::visit(look, camera);
  if (const auto* lens = std::get_if<PerspectiveCamera>(&camera)) {
    half_height = std::tan(glm::radians(lens->fov) / 2);
    aperture_radius_ = static_cast<float>(lens->aperture_radius);
    focus_distance_ = static_cast<float>(
        lens->focus_distance.value_or(glm::length(lens->look_at - lens->position)));
  } else {
    perspective_ = false;
    half_height = std::get<OrthographicCamera>(camera).height / 2;
  }
  half_height_ = static_cast<float>(half_height);
  half_width_ = static_cast<float>(half_height * film.width / film.height);
}

Vec3 CameraRays::from_axis(float x, float y) const {
  const float sx = (2 * x / width_ - 1) * half_width_;
  const float sy = (1 - 2 * y / height_) * half_height_;
  return sx * right_ + sy * up_;
}

Ray CameraRays::central(int x, int y) const {
  const Vec3 offset = from_axis(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
  Ray ray;
  ray.origin = perspective_ ? position_ : position_ + offset;
  ray.direction = perspective_ ? glm::normalize(forward_ + offset) : forward_;
  if (aperture_radius_ == 0) ray.bundle = camera_bundle;
  return ray;
}

Vec4 CameraRays::project(const Vec3& point) const {
  const Vec3 away = point - position_;
  const float z = glm::dot(forward_, away);
  const float w = perspective_ ? z : 1;
  return {(w + glm::dot(right_, away) / half_width_) * width_ / 2.0F,
          (w - glm::dot(up_, away) / half_height_) * height_ / 2.0F, z, w};
}

CameraRay CameraRays::generate(int x, int y, NumberReader& numbers) const {
  const Vec2 u = numbers.next_2d();
  const Vec2 offset = filter_ == PixelFilter::box ? sample_box(u, filter_radius_)
                                                  : sample_blackman_harris(u, filter_radius_);
  const Vec3 across =
      from_axis(static_cast<float>(x) + 0.5F + offset.x, static_cast<float>(y) + 0.5F + offset.y);
  const float pixel = pixel_width();

  CameraRay out;
  if (!perspective_) {
    out.ray.origin = position_ + across;
    out.ray.direction = forward_;
    out.ray.bundle = camera_bundle;
    out.cone_width = pixel;
    return out;
  }
  out.cone_spread = pixel;
  const Vec3 direction = forward_ + across;  // 1 along the axis
  if (aperture_radius_ == 0) {
    out.ray = {position_, std::numeric_limits<float>::infinity(), glm::normalize(direction),
               camera_bundle};
    return out;
  }
  const Vec2 lens = aperture_radius_ * sample_unit_disk(numbers.next_2d());
  const Vec3 shift = lens.x * right_ + lens.y * up_;
  out.ray.origin = position_ + shift;
  out.ray.direction = glm::normalize(focus_distance_ * direction - shift);
  return out;
}

}  // namespace pah
