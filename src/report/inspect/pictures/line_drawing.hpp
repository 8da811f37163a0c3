// Lines drawn over a picture, faint where a surface hides them.
#pragma once

#include <limits>
#include <pah/accel/accelerator.hpp>
#include <pah/image/image.hpp>
#include <pah/scene/world.hpp>
#include <vector>

#include "render/path/camera_rays.hpp"
#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// The plane of the surface that a pixel's central ray meets. The camera's side of it is where
// dot(normal, point) > offset: everywhere, if nothing is met.
struct SeenPlane {
  Vec3 normal{0};
  float offset = -std::numeric_limits<float>::infinity();
};

// Rows from the top.
[[nodiscard]] std::vector<SeenPlane> seen_planes(const World& world, const Accelerator& accelerator,
                                                 const FilmSettings& film);

// `width` is in pixels, `planes` are the picture's. Only lines before the camera are drawn. Where
// lines of the set cross, one of them is seen.
void draw_lines(const LineSet& lines, float width, const CameraRays& camera,
                const std::vector<SeenPlane>& planes, Image& picture);

}  // namespace pah
