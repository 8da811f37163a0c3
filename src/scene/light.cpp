#include <cmath>
#include <pah/scene/light.hpp>

namespace pah {

std::optional<ExactBundle> exact_bundle(const Light& light) {
  if (const auto* point = std::get_if<PointLight>(&light.model))
    return PointBundle{Vec3(point->position)};
  if (const auto* spot = std::get_if<SpotLight>(&light.model))
    return PointBundle{Vec3(spot->position), Vec3(glm::normalize(spot->direction)),
                       static_cast<float>(std::sin(glm::radians(spot->angle)))};
  const auto* sun = std::get_if<DirectionalLight>(&light.model);
  if (sun == nullptr) return {};
  return ParallelBundle{Vec3(-glm::normalize(sun->direction)),
                        static_cast<float>(std::tan(glm::radians(sun->angle / 2)))};
}

}  // namespace pah
