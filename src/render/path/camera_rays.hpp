// Generates rays from the camera through a pixel.
#pragma once

#include <pah/geometry/ray.hpp>
#include <pah/scene/camera.hpp>
#include <pah/scene/settings.hpp>

#include "render/sampling/drawn_numbers.hpp"

namespace pah {

// A ray of unit direction and the cone that its pixel fills around it: Akenine-Moeller et al.,
// "Texture Level of Detail Strategies for Real-Time Ray Tracing" (Ray Tracing Gems, 2019).
struct CameraRay {
  Ray ray;
  float cone_width = 0;   // at the origin, a length
  float cone_spread = 0;  // growth per unit of length
};

class CameraRays {
 public:
  CameraRays(const Camera& camera, const FilmSettings& film);

  // The filter is importance-sampled: every sample belongs to its pixel, with weight 1.
  [[nodiscard]] CameraRay generate(int x, int y, NumberReader& numbers) const;

  // The number of random dimensions that generate() uses.
  [[nodiscard]] std::uint32_t dimensions() const { return aperture_radius_ > 0 ? 2 : 1; }

  // The ray through the centers of the pixel and of the lens.
  [[nodiscard]] Ray central(int x, int y) const;

  // Projects a point to homogeneous coordinates: (x, y) / w is its position in the picture, in
  // pixels, and z its distance along the axis. w is z for perspective cameras, else 1. Camera rays
  // meet z > 0 only.
  [[nodiscard]] Vec4 project(const Vec3& point) const;

  // The width of a pixel at w = 1, as a length.
  [[nodiscard]] float pixel_width() const { return 2 * half_height_ / height_; }

 private:
  // From the axis to the point (x, y), in pixels, of the picture.
  [[nodiscard]] Vec3 from_axis(float x, float y) const;

  PixelFilter filter_;
  float filter_radius_;
  float width_, height_;  // pixels
  Vec3 position_, forward_, right_, up_;
  float half_width_, half_height_;  // of the picture, at distance 1 if perspective
  bool perspective_ = true;
  float aperture_radius_ = 0;
  float focus_distance_ = 1;
};

}  // namespace pah
