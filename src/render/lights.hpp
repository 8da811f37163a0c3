// The lights of a World made ready for sampling.
//
// Every kind has the same few functions: draw a direction towards it, tell the density of having
// drawn one, tell what it emits. Kinds that a ray can meet by chance (area lights, the environment,
// suns with an angular diameter) have both; points, spots and parallel light are delta lights.
#pragma once

#include <optional>
#include <pah/geometry/ray.hpp>
#include <pah/image/image.hpp>
#include <pah/scene/world.hpp>
#include <variant>
#include <vector>

#include "render/alias_table.hpp"
#include "render/environment.hpp"
#include "render/light_sampler.hpp"
#include "scene/texture_store.hpp"

namespace pah {

struct LightSample {
  Vec3 radiance{0};   // W/(m2 sr), arriving unless something is in between; W/m2 if delta
  Vec3 direction{0};  // towards the light, of unit length
  float pdf = 0;      // per solid angle; 1 if delta
  bool delta = false;
  bool distant = false;                  // at infinity: no target
  Vec3 target{0};                        // where the shadow segment ends,
  float target_error = 0;                // give or take this length
  std::uint32_t triangle = no_triangle;  // of an area light
  Vec2 barycentrics{0};
};

struct PointEmitter {
  Vec3 position{0};
  Vec3 intensity{0};
};

struct SpotEmitter {
  Vec3 position{0};
  Vec3 axis{0, -1, 0};
  Vec3 intensity{0};
  float cos_inner = 1, cos_outer = 1;
};

struct DirectionalEmitter {
  Vec3 axis{0, 1, 0};  // towards the light
  Vec3 irradiance{0};
  float one_minus_cos = 0;  // of the half-angle; 0 for parallel light
  Vec3 radiance{0};         // if not parallel
};

struct EmittingTriangle {
  Triangle corners;
  Vec3 normal{0};
  std::uint32_t index = 0;
  double area = 0;
};

struct AreaEmitter {
  ColorInput radiance{Vec3(0)};
  float mean_radiance = 0;  // of the channels, and of the image
  bool two_sided = false;
  double area = 0;  // 0: nothing emits
  std::vector<EmittingTriangle> triangles;
  AliasTable by_area;
};

struct EnvironmentEmitter {
  Vec3 radiance{0};
  glm::mat3 world_from_light{1.0F};
  Image image;  // empty if constant
  std::optional<LatLongDistribution> distribution;
};

using Emitter =
    std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, AreaEmitter, EnvironmentEmitter>;

class Lights {
 public:
  // World and textures must outlive the lights. Throws TextureError if a light's image cannot be
  // read.
  Lights(const World& world, const TextureStore& textures);

  [[nodiscard]] const LightSampler& sampler() const { return sampler_; }
  [[nodiscard]] std::size_t size() const { return emitters_.size(); }

  // Nothing where the light does not shine.
  [[nodiscard]] std::optional<LightSample> sample(LightId light, const LitPoint& at, float u,
                                                  const Vec2& u2) const;

  // What a triangle of an area light emits towards `direction`, where its texture coordinates are
  // `uv`.
  [[nodiscard]] Vec3 emitted(LightId light, const Vec3& normal, const Vec3& direction,
                             const Vec2& uv) const;
  // The density per solid angle with which `sample(light, at)` draws this point of a triangle.
  [[nodiscard]] float pdf_area(LightId light, const LitPoint& at, std::uint32_t triangle,
                               const Vec3& position, const Vec3& normal) const;

  // The lights at infinity that a ray which leaves the scene may meet.
  [[nodiscard]] const std::vector<LightId>& visible_distant() const { return visible_distant_; }
  [[nodiscard]] Vec3 distant_radiance(LightId light, const Vec3& direction) const;
  [[nodiscard]] float pdf_distant(LightId light, const LitPoint& at, const Vec3& direction) const;

  // Whether anything can be met by a ray, that is, whether looking for it is worth a ray.
  [[nodiscard]] bool any_visible() const { return any_visible_; }

 private:
  [[nodiscard]] std::optional<LightSample> sample_area(const AreaEmitter& emitter,
                                                       const LitPoint& at, float u,
                                                       const Vec2& u2) const;

  const World& world_;
  const TextureStore& textures_;
  std::vector<Emitter> emitters_;
  std::vector<LightId> visible_distant_;
  bool any_visible_ = false;
  LightSampler sampler_;
};

// The unit normal of the side from which the vertices run counter-clockwise; zero if degenerate.
[[nodiscard]] Vec3 geometric_normal(const Triangle& triangle);
[[nodiscard]] double area(const Triangle& triangle);

}  // namespace pah
