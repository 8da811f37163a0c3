// Environments: light from every direction, constant or from a lat-long picture.
#pragma once

#include <optional>
#include <pah/image/image.hpp>
#include <pah/scene/light.hpp>

#include "image/texture/store.hpp"
#include "render/light/lat_long.hpp"
#include "render/light/light_sample.hpp"

namespace pah {

struct EnvironmentEmitter {
  Vec3 radiance{0};  // W/(m2 sr); a factor of the image's
  glm::mat3 world_from_light{1.0F};
  Image image;                                      // empty if constant
  std::optional<LatLongDistribution> distribution;  // of the image
};

// Throws TextureError if the image cannot be read.
[[nodiscard]] EnvironmentEmitter prepare(const EnvironmentLight& light,
                                         const TextureStore& textures);
[[nodiscard]] std::optional<LightSample> sample(const EnvironmentEmitter& emitter,
                                                const LitPoint& at, const LightNumbers& numbers);
[[nodiscard]] DistantBounds bounds(const EnvironmentEmitter& emitter);

// Whether a ray that leaves the scene may meet the light: always.
[[nodiscard]] inline bool is_visible_at_infinity(const EnvironmentEmitter& /*emitter*/) {
  return true;
}
[[nodiscard]] Vec3 distant_radiance(const EnvironmentEmitter& emitter, const Vec3& direction);
// The density per solid angle with which sample() draws the direction.
[[nodiscard]] float distant_pdf(const EnvironmentEmitter& emitter, const LitPoint& at,
                                const Vec3& direction);

}  // namespace pah
