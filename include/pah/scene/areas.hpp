// The influence areas of a scene: declared by hand, or derived from its lights and its camera.
#pragma once

#include <pah/influence/influence_area.hpp>
#include <pah/scene/world.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pah {

struct SceneArea {
  std::string name;   // the light's, with a side or a number where it has several: "lamp +x"
  std::string light;  // or "camera"
  std::uint32_t bundle = no_bundle;  // the light's index, or camera_bundle
  InfluenceArea area;                // in coordinates of the World
  bool declared = false;             // by hand; else derived
};

// The shape of the ray bundle of a light or camera. Only rays that meet in a point or run in
// parallel have influence areas.
enum class BundleShape { point, parallel, neither };
[[nodiscard]] BundleShape bundle_shape(const Light& light);
[[nodiscard]] BundleShape bundle_shape(const Camera& camera);

// "plane" or "point", as in the scene language.
[[nodiscard]] std::string_view type_name(const InfluenceArea& area);

// Returns the declared areas, then the derived ones if the settings ask for them. A derived area
// holds every ray of its bundle that starts in the scene's box, except rays that rounding puts
// outside of a spot's cone; up to six areas share the rays of a point light. No area is derived for
// a bundle that is neither a point's nor parallel, or without triangles. Throws
// std::invalid_argument for a declaration whose light does not exist or has another bundle shape.
[[nodiscard]] std::vector<SceneArea> areas_of(const World& world, const InfluenceSettings& settings,
                                              const FilmSettings& film);

}  // namespace pah
