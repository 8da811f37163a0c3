#include "report/inspect/pictures/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <pah/render/render.hpp>
#include <ranges>

#include "report/inspect/pictures/line_drawing.hpp"

namespace pah {

Image draft_picture(const World& world, const Accelerator& accelerator, const Scene& settings) {
  constexpr int most_samples = 16;
  FilmSettings film = settings.film;
  film.crop.reset();
  RenderSettings render_settings = settings.render;
  render_settings.samples = std::min(render_settings.samples, most_samples);
  Image picture = radiance_of(render(world, accelerator, film, render_settings).film);
  const auto factor = static_cast<float>(std::exp2(film.exposure));
  for (Vec3& pixel : picture.pixels) pixel = glm::clamp(factor * pixel, 0.0F, 1.0F);
  return picture;
}

void draw_over(Image& picture, const World& world, const Accelerator& accelerator,
               const FilmSettings& film, const std::vector<LineSet>& boxes,
               const std::vector<LineSet>& areas) {
  constexpr float box_width = 0.6F, area_width = 1.6F;
  const CameraRays camera(world.camera, film);
  const std::vector<SeenPlane> planes = seen_planes(world, accelerator, film);
  for (const LineSet& set : std::views::reverse(boxes))
    draw_lines(set, box_width, camera, planes, picture);
  for (const LineSet& set : areas) draw_lines(set, area_width, camera, planes, picture);
}

}  // namespace pah
