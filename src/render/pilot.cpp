#include "render/pilot.hpp"

#include <algorithm>

#include "geometry/mix_bits.hpp"
#include "render/camera_rays.hpp"
#include "render/surface_interaction.hpp"
#include "render/warp.hpp"

namespace pah {
namespace {

// Neighboring pixels share memory, as in a render, so there are squares of them, spread evenly.
constexpr int squares_across = 6;
constexpr int square_size = 12;  // pixels
constexpr int most_surfaces = 3;
// Where there are many lights, each gets fewer rays than there are points.
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

// A surface that a path met, on the side that it came from.
struct Met {
  SurfacePoint point;
  Vec3 side{0};
};

std::vector<Met> meet(const World& world, const Accelerator& accelerator,
                      const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  accelerator.closest_hit(rays, hits);
  std::vector<Met> met;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].valid()) continue;
    const SurfacePoint point = interact(world, hits[i]).point;
    const bool behind = glm::dot(rays[i].direction, point.normal) > 0;
    met.push_back({point, behind ? -point.normal : point.normal});
  }
  return met;
}

Ray to_light(const PointBundle& light, const Met& from, std::uint32_t bundle, Random& /*random*/) {
  return spawn_segment(from.point, light.eye, 0, bundle);
}
Ray to_light(const ParallelBundle& light, const Met& from, std::uint32_t bundle, Random& random) {
  Vec3 direction = light.toward;
  if (light.tangent > 0) {
    const Vec2 lean = light.tangent * sample_unit_disk(random.next_2d());
    direction = glm::normalize(make_frame(light.toward).world_from_local({lean.x, lean.y, 1}));
  }
  Ray ray = spawn_ray(from.point, direction);
  ray.bundle = bundle;
  return ray;
}

bool is_lit(const PointBundle& light, const Met& at) {
  const Vec3 away = at.point.position - light.eye;
  const float along = glm::dot(light.axis, away);
  const bool in_cone =
      light.sine >= 1 ||
      (along > 0 && along * along >= (1 - light.sine * light.sine) * glm::dot(away, away));
  return in_cone && glm::dot(at.side, away) < 0;
}
bool is_lit(const ParallelBundle& light, const Met& at) {
  return glm::dot(at.side, light.toward) > 0;
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
    const std::vector<Met> met = meet(world, accelerator, rays);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (const Met& at : met) {
        std::visit(
            [&](const auto& light) {
              if (!is_lit(light, at)) return;
              to[i].expected += worth;
              if (to[i].rays.size() < most_rays / lights.size())
                to[i].rays.push_back(to_light(light, at, lights[i].light, random));
            },
            lights[i].rays);
      }
    }
    rays.clear();
    for (const Met& at : met) {
      const Vec3 local = sample_cosine_hemisphere(random.next_2d());
      rays.push_back(spawn_ray(at.point, make_frame(at.side).world_from_local(local)));
    }
  }
  return to;
}

}  // namespace pah
