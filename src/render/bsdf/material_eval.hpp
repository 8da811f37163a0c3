// Evaluates materials and their textures at a point.
#pragma once

#include <pah/scene/material.hpp>

#include "image/texture/store.hpp"
#include "render/bsdf/bsdf.hpp"

namespace pah {

// `footprint` is the width of the filter in texture coordinates, >= 0; 0 takes the finest level.
// Values from textures and vertices are clamped to the range that the model allows.
[[nodiscard]] Bsdf resolve_material(const Material& material, const TextureStore& textures, Vec2 uv,
                                    float footprint, const Vec3& vertex_color = Vec3(1));

// Returns whether light may pass straight through.
[[nodiscard]] inline bool is_masked(const Material& material) {
  return material.opacity.value != 1 || material.opacity.texture != no_texture;
}
// The share of light that is stopped, in [0, 1]; 1 - opacity passes straight through.
[[nodiscard]] float opacity(const Material& material, const TextureStore& textures, Vec2 uv,
                            float footprint);

// The normal map's unit normal in tangent space (x along dp/du), z > 0; +z if there is no map.
[[nodiscard]] Vec3 mapped_normal(const Material& material, const TextureStore& textures, Vec2 uv,
                                 float footprint);

}  // namespace pah
