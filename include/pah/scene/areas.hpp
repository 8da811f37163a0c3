// The influence areas of a scene: those it declares, and those its lights and camera suggest.
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

// How the rays of a light or a camera lie to each other: only those that meet in a point or run in
// parallel have influence areas.
enum class BundleShape { point, parallel, neither };
[[nodiscard]] BundleShape bundle_shape(const Light& light);
[[nodiscard]] BundleShape bundle_shape(const Camera& camera);

// "plane" or "point", as in the scene language.
[[nodiscard]] std::string_view type_name(const InfluenceArea& area);

// The declared areas, then the derived ones, if any are asked for. A derived area holds every ray
// of its bundle that starts in the scene's box (a point light's are shared by up to six), but for
// what rounding puts outside of a spot's cone. None is derived where rays neither meet in a point
// nor are parallel, nor where there are no triangles. Throws std::invalid_argument for a
// declaration that names no light, or one whose rays are not of its kind.
[[nodiscard]] std::vector<SceneArea> areas_of(const World& world, const InfluenceSettings& settings,
                                              const FilmSettings& film);

}  // namespace pah
