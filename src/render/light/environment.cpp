#include "render/light/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sampling/warp.hpp"
#include "render/surface/shading_frame.hpp"

namespace pah {

using std::numbers::pi_v;

EnvironmentEmitter prepare(const EnvironmentLight& light, const TextureStore& textures) {
  EnvironmentEmitter emitter;
  emitter.radiance = light.radiance;
  emitter.world_from_light = glm::mat3(light.world_from_light);
  if (light.image == no_texture) return emitter;
  emitter.image = textures.image(light.image);
  std::vector<float> brightness;
  brightness.reserve(emitter.image.pixels.size());
  for (Vec3& pixel : emitter.image.pixels) {
    pixel = glm::max(pixel, Vec3(0));
    brightness.push_back(mean_of(emitter.radiance * pixel));
  }
  emitter.distribution.emplace(brightness, emitter.image.width, emitter.image.height);
  return emitter;
}

std::optional<LightSample> sample(const EnvironmentEmitter& emitter, const LitPoint& at,
                                  const LightNumbers& numbers) {
  Vec3 direction;
  float pdf = 0;
  if (emitter.distribution) {
    const auto drawn = emitter.distribution->sample(numbers.point);
    direction = emitter.world_from_light * drawn.direction;
    pdf = drawn.pdf;
  } else {
    direction =
        at.transmits
            ? sample_uniform_sphere(numbers.point)
            : make_frame(at.normal).world_from_local(sample_cosine_hemisphere(numbers.point));
    pdf = distant_pdf(emitter, at, direction);
  }
  if (!(pdf > 0)) return std::nullopt;
  return sample_toward_infinity(distant_radiance(emitter, direction), direction, pdf);
}

DistantBounds bounds(const EnvironmentEmitter& emitter) {
  const float mean = emitter.distribution ? static_cast<float>(emitter.distribution->mean())
                                          : mean_of(emitter.radiance);
  return distant_bounds(Vec3(0, 1, 0), pi_v<float>, pi_v<float> * mean);
}

Vec3 distant_radiance(const EnvironmentEmitter& emitter, const Vec3& direction) {
  if (!emitter.distribution) return emitter.radiance;
  const Image& image = emitter.image;
  const Vec2 uv = lat_long_from_direction(glm::transpose(emitter.world_from_light) * direction);
  const float x = uv.x * static_cast<float>(image.width) - 0.5F;
  const float y = std::clamp(uv.y * static_cast<float>(image.height) - 0.5F, 0.0F,
                             static_cast<float>(image.height - 1));
  const float x_floor = std::floor(x), y_floor = std::floor(y);
  const int x0 = (static_cast<int>(x_floor) + image.width) % image.width;
  const int x1 = (x0 + 1) % image.width;
  const int y0 = static_cast<int>(y_floor);
  const int y1 = std::min(y0 + 1, image.height - 1);
  const auto texel = [&](int column, int row) {
    return image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(column)];
  };
  const Vec3 top = glm::mix(texel(x0, y0), texel(x1, y0), x - x_floor);
  const Vec3 bottom = glm::mix(texel(x0, y1), texel(x1, y1), x - x_floor);
  return emitter.radiance * glm::mix(top, bottom, y - y_floor);
}

// A constant environment is sampled by the cosine, or uniformly if light from behind counts, too.
float distant_pdf(const EnvironmentEmitter& emitter, const LitPoint& at, const Vec3& direction) {
  if (emitter.distribution) {
    return emitter.distribution->pdf(glm::transpose(emitter.world_from_light) * direction);
  }
  if (at.transmits) return pdf_uniform_sphere();
  return std::max(0.0F, glm::dot(direction, at.normal)) / pi_v<float>;
}

}  // namespace pah
