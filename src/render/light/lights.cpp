#include "render/light/lights.hpp"

#include <concepts>
#include <utility>

namespace pah {
namespace {

Emitter prepare_any(const Light& light, const World& world, const TextureStore& textures) {
  return std::visit(
      [&](const auto& model) -> Emitter {
        if constexpr (requires { prepare(model); })
          return prepare(model);
        else if constexpr (requires { prepare(model, textures); })
          return prepare(model, textures);
        else
          return prepare(model, world, textures);
      },
      light.model);
}

void gather_triangles(const World& world, std::vector<Emitter>& emitters) {
  for (const Surface& surface : world.surfaces)
    if (surface.light != no_light)
      add_surface(std::get<AreaEmitter>(emitters[surface.light]), surface);
  for (Emitter& emitter : emitters)
    if (auto* area_light = std::get_if<AreaEmitter>(&emitter)) finish(*area_light);
}

// Lights without power are left out.
LightSampler make_sampler(const std::vector<Emitter>& emitters) {
  std::vector<LightSampler::Placed> placed;
  std::vector<LightSampler::Distant> distant;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const auto id = static_cast<LightId>(i);
    const auto add = [&](const auto& emitter) {
      const auto bounded = bounds(emitter);
      if constexpr (std::same_as<decltype(bounded), const LightBounds>) {
        if (bounded.intensity > 0) placed.push_back({id, bounded});
      } else {
        if (bounded.irradiance > 0) distant.push_back({id, bounded});
      }
    };
    std::visit(add, emitters[i]);
  }
  return {std::move(placed), std::move(distant), emitters.size()};
}

// Lights at a finite distance: no ray meets them at infinity.
bool is_visible_at_infinity(const auto& /*emitter*/) { return false; }
Vec3 distant_radiance(const auto& /*emitter*/, const Vec3& /*direction*/) { return Vec3(0); }
float distant_pdf(const auto& /*emitter*/, const LitPoint& /*at*/, const Vec3& /*direction*/) {
  return 0;
}

bool any_visible_at_infinity(const Emitter& any) {
  return std::visit([](const auto& emitter) { return is_visible_at_infinity(emitter); }, any);
}

Vec3 any_distant_radiance(const Emitter& any, const Vec3& direction) {
  return std::visit([&](const auto& emitter) { return distant_radiance(emitter, direction); }, any);
}

float any_distant_pdf(const Emitter& any, const LitPoint& at, const Vec3& direction) {
  return std::visit([&](const auto& emitter) { return distant_pdf(emitter, at, direction); }, any);
}

}  // namespace

Lights::Lights(const World& world, const TextureStore& textures) {
  emitters_.reserve(world.lights.size());
  for (const Light& light : world.lights) emitters_.push_back(prepare_any(light, world, textures));
  gather_triangles(world, emitters_);
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    if (any_visible_at_infinity(emitters_[i])) visible_distant_.push_back(static_cast<LightId>(i));
    const auto* area_light = std::get_if<AreaEmitter>(&emitters_[i]);
    any_visible_ = any_visible_ || (area_light != nullptr && area_light->surface_area > 0);
  }
  any_visible_ = any_visible_ || !visible_distant_.empty();
  sampler_ = make_sampler(emitters_);
}

std::optional<LightSample> Lights::sample(LightId light, const LitPoint& at,
                                          const LightNumbers& numbers) const {
  return std::visit([&](const auto& emitter) { return pah::sample(emitter, at, numbers); },
                    emitters_[light]);
}

Vec3 Lights::emitted(LightId light, const Vec3& normal, const Vec3& direction,
                     const Vec2& uv) const {
  return pah::emitted(std::get<AreaEmitter>(emitters_[light]), normal, direction, uv);
}

float Lights::area_pdf(LightId light, const LitPoint& at, std::uint32_t triangle,
                       const Vec3& position, const Vec3& normal) const {
  return pdf(std::get<AreaEmitter>(emitters_[light]), at, triangle, position, normal);
}

Vec3 Lights::distant_radiance(LightId light, const Vec3& direction) const {
  return any_distant_radiance(emitters_[light], direction);
}

float Lights::distant_pdf(LightId light, const LitPoint& at, const Vec3& direction) const {
  return any_distant_pdf(emitters_[light], at, direction);
}

}  // namespace pah
