// Area lights: emissive triangles, with a texture if the scene gives one.
#pragma once

#include <pah/scene/world.hpp>
#include <vector>

#include "image/texture/store.hpp"
#include "render/light/light_sample.hpp"
#include "render/sampling/alias_table.hpp"

namespace pah {

struct EmittingTriangle {
  Triangle corners;
  Vec3 normal{0};
  std::uint32_t index = 0;
  double surface_area = 0;
};

struct AreaEmitter {
  const World* world = nullptr;
  const TextureStore* textures = nullptr;
  ColorInput radiance{Vec3(0)};  // W/(m2 sr)
  float mean_radiance = 0;       // of the channels, and of the image
  bool two_sided = false;
  double surface_area = 0;  // 0: nothing emits
  std::vector<EmittingTriangle> triangles;
  AliasTable by_surface_area;
};

// An emitter without triangles yet. World and textures must outlive it. Throws TextureError if its
// image cannot be read.
[[nodiscard]] AreaEmitter prepare(const AreaLight& light, const World& world,
                                  const TextureStore& textures);
// Adds the triangles of a surface. To be called for every surface of the light, then finish().
void add_surface(AreaEmitter& emitter, const Surface& surface);
void finish(AreaEmitter& emitter);

[[nodiscard]] std::optional<LightSample> sample(const AreaEmitter& emitter, const LitPoint& at,
                                                const LightNumbers& numbers);
[[nodiscard]] LightBounds bounds(const AreaEmitter& emitter);

// The radiance that leaves a triangle with this normal towards `direction`.
[[nodiscard]] Vec3 emitted(const AreaEmitter& emitter, const Vec3& normal, const Vec3& direction,
                           const Vec2& uv);
// The density per solid angle with which sample() draws this position on a triangle.
[[nodiscard]] float pdf(const AreaEmitter& emitter, const LitPoint& at, std::uint32_t triangle,
                        const Vec3& position, const Vec3& normal);

}  // namespace pah
