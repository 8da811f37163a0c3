// All lights of a World, made ready for sampling.
//
// To add a light, write a file with a struct and this overload set, and add it to Emitter:
//   prepare(light, ...)               from the scene's value
//   sample(emitter, at, numbers)      a direction towards the light, with its density
//   bounds(emitter)                   for the choice among lights (light_importance.hpp)
// A light at infinity that rays can meet also has is_visible_at_infinity(), distant_radiance() and
// distant_pdf(); one with a surface has emitted() and pdf().
#pragma once

#include <optional>
#include <pah/scene/world.hpp>
#include <variant>
#include <vector>

#include "image/texture/store.hpp"
#include "render/light/area.hpp"
#include "render/light/directional.hpp"
#include "render/light/environment.hpp"
#include "render/light/light_sampler.hpp"
#include "render/light/point.hpp"
#include "render/light/spot.hpp"

namespace pah {

using Emitter =
    std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, AreaEmitter, EnvironmentEmitter>;

class Lights {
 public:
  // World and textures must outlive the lights. Throws TextureError if a light's image cannot be
  // read.
  Lights(const World& world, const TextureStore& textures);

  [[nodiscard]] const LightSampler& sampler() const { return sampler_; }
  [[nodiscard]] std::size_t size() const { return emitters_.size(); }

  // No sample where the light does not shine.
  [[nodiscard]] std::optional<LightSample> sample(LightId light, const LitPoint& at,
                                                  const LightNumbers& numbers) const;

  // The radiance that a triangle of an area light emits towards `direction` at texture coordinates
  // `uv`.
  [[nodiscard]] Vec3 emitted(LightId light, const Vec3& normal, const Vec3& direction,
                             const Vec2& uv) const;
  // The density per solid angle with which sample() draws this position on a triangle.
  [[nodiscard]] float area_pdf(LightId light, const LitPoint& at, std::uint32_t triangle,
                               const Vec3& position, const Vec3& normal) const;

  // The lights at infinity that a ray which leaves the scene may meet.
  [[nodiscard]] const std::vector<LightId>& visible_distant() const { return visible_distant_; }
  [[nodiscard]] Vec3 distant_radiance(LightId light, const Vec3& direction) const;
  [[nodiscard]] float distant_pdf(LightId light, const LitPoint& at, const Vec3& direction) const;

  // Whether a ray can meet any light by chance: without one, BSDF sampling finds none.
  [[nodiscard]] bool any_visible() const { return any_visible_; }

 private:
  std::vector<Emitter> emitters_;
  std::vector<LightId> visible_distant_;
  bool any_visible_ = false;
  LightSampler sampler_;
};

}  // namespace pah
