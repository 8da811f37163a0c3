// Draws lines over a picture, faintly where a surface hides them.
#pragma once

#include <limits>
#include <pah/accel/accelerator.hpp>
#include <pah/image/image.hpp>
#include <pah/scene/world.hpp>
#include <vector>

#include "render/path/camera_rays.hpp"
#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// The plane of the surface that a pixel's central ray meets. Points with dot(normal, point) >
// offset are on the camera's side; all points are if the ray meets nothing.
struct SeenPlane {
  Vec3 normal{0};
  float offset = -std::numeric_limits<float>::infinity();
};

// Rows from the top.
[[nodiscard]] std::vector<SeenPlane> seen_planes(const World& world, const Accelerator& accelerator,
                                                 const FilmSettings& film);

// Draws the lines in front of the camera. `width` is in pixels; `planes` come from seen_planes().
// Where lines of the set cross, one of them is visible.
void draw_lines(const LineSet& lines, float width, const CameraRays& camera,
                const std::vector<SeenPlane>& planes, Image& picture);

}  // namespace pah
