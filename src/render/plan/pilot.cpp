#include "render/plan/pilot.hpp"

#include <algorithm>

#include "base/mix_bits.hpp"
#include "render/path/camera_rays.hpp"
#include "render/sampling/warp.hpp"
#include "render/surface/seen_point.hpp"
#include "render/surface/shading_frame.hpp"

namespace pah {
namespace {

// The pilot uses evenly spread squares of pixels, because neighboring pixels share cache lines, as
// in a render.
constexpr int squares_across = 6;
constexpr int square_size = 12;  // pixels
constexpr int most_surfaces = 3;
// With many lights, each gets fewer rays than there are points.
constexpr std::size_t most_rays = std::size_t{1} << 17U;

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix_bits(seed + 1)) {}
  [[nodiscard]] Vec2 next_2d() {
    state_ = mix_bits(state_ + 0x9E3779B97F4A7C15U);
    constexpr float scale = 0x1p-24F;
    return {static_cast<float>(state_ >> 40U) * scale,
            static_cast<float>(state_ >> 8U & 0xFFFFFFU) * scale};
  }

 private:
  std::uint64_t state_;
};

std::vector<Ray> camera_rays(const Camera& camera, const FilmSettings& film) {
  const CameraRays through(camera, film);
  const PixelRect rect = pixels_of(film);
  std::vector<Ray> rays;
  // The first pixel of a square, along one axis of the picture.
  const auto first = [](int begin, int size, int square) {
    return begin + size * square / squares_across;
  };
  for (int i = 0; i < squares_across * squares_across; ++i) {
    const int x0 = first(rect.x0, rect.width(), i % squares_across);
    const int y0 = first(rect.y0, rect.height(), i / squares_across);
    for (int y = y0; y < std::min(y0 + square_size, rect.y1); ++y) {
      for (int x = x0; x < std::min(x0 + square_size, rect.x1); ++x)
        rays.push_back(through.central(x, y));
    }
  }
  return rays;
}

std::vector<SeenPoint> meet(const World& world, const Accelerator& accelerator,
                            const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  accelerator.closest_hit(rays, hits);
  std::vector<SeenPoint> met;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].valid()) met.push_back(seen_point(world, rays[i], hits[i]));
  return met;
}

Vec2 lean_to(const ExactBundle& light, Random& random) {
  const auto* parallel = std::get_if<ParallelBundle>(&light);
  return parallel != nullptr && parallel->tangent > 0 ? sample_unit_disk(random.next_2d())
                                                      : Vec2(0);
}

}  // namespace

std::vector<PilotRays> pilot_rays(const World& world, const Scene& settings,
                                  const Accelerator& accelerator,
                                  const std::vector<PilotLight>& lights) {
  std::vector<PilotRays> to(lights.size());
  const PixelRect rect = pixels_of(settings.film);
  std::vector<Ray> rays = camera_rays(world.camera, settings.film);
  if (rays.empty()) return to;
  const double samples =
      static_cast<double>(rect.width()) * rect.height() * settings.render.samples;
  const double worth =
      samples / (static_cast<double>(rays.size()) * static_cast<double>(world.lights.size()));
  Random random(settings.render.seed);
  for (int depth = 0; depth < std::min(settings.render.max_depth, most_surfaces); ++depth) {
    const std::vector<SeenPoint> met = meet(world, accelerator, rays);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (const SeenPoint& at : met) {
        const ExactBundle& light = lights[i].rays;
        if (!is_lit(at, light)) continue;
        to[i].expected += worth;
        if (to[i].rays.size() < most_rays / lights.size())
          to[i].rays.push_back(ray_to(at, light, lights[i].light, lean_to(light, random)));
      }
    }
    rays.clear();
    for (const SeenPoint& at : met) {
      const Vec3 local = sample_cosine_hemisphere(random.next_2d());
      rays.push_back(spawn_ray(at.point, make_frame(at.side).world_from_local(local)));
    }
  }
  return to;
}

}  // namespace pah
