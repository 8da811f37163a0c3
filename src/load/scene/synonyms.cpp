#include "load/scene/synonyms.hpp"

#include <algorithm>
#include <iterator>

namespace pah {
namespace {

struct Synonym {
  std::string_view elsewhere;
  std::string_view here;
};

// Of several synonyms, the first that the map has applies.
constexpr Synonym synonyms[] = {{"power", "intensity"},
                                {"power", "irradiance"},
                                {"power", "radiance"},
                                {"energy", "intensity"},
                                {"energy", "irradiance"},
                                {"energy", "radiance"},
                                {"strength", "intensity"},
                                {"strength", "irradiance"},
                                {"strength", "radiance"},
                                {"emission", "radiance"},
                                {"brightness", "intensity"},
                                {"brightness", "radiance"},
                                {"color", "intensity"},
                                {"color", "irradiance"},
                                {"color", "radiance"},
                                {"color", "reflectance"},
                                {"color", "base_color"},
                                {"color", "tint"},
                                {"colour", "intensity"},
                                {"colour", "irradiance"},
                                {"colour", "radiance"},
                                {"colour", "reflectance"},
                                {"colour", "base_color"},
                                {"albedo", "reflectance"},
                                {"albedo", "base_color"},
                                {"diffuse", "reflectance"},
                                {"diffuse", "base_color"},
                                {"Kd", "reflectance"},
                                {"alpha", "opacity"},
                                {"transparency", "opacity"},
                                {"bump", "normal_map"},
                                {"metalness", "metallic"},
                                {"focal_length", "fov"},
                                {"field_of_view", "fov"},
                                {"focal_distance", "focus_distance"},
                                {"aperture", "aperture_radius"},
                                {"lens_radius", "aperture_radius"},
                                {"target", "look_at"},
                                {"lookat", "look_at"},
                                {"to", "look_at"},
                                {"location", "position"},
                                {"origin", "position"},
                                {"from", "position"},
                                {"eye", "position"},
                                {"cone_angle", "angle"},
                                {"spp", "samples"},
                                {"depth", "max_depth"},
                                {"bounces", "max_depth"},
                                {"filename", "file"},
                                {"path", "file"},
                                {"mesh", "file"},
                                {"geometry", "shape"},
                                {"diameter", "radius"},
                                {"translate", "transform"},
                                {"rotate", "transform"},
                                {"scale", "transform"},
                                {"rotation", "transform"},
                                {"translation", "transform"},
                                {"location", "transform"},
                                {"position", "transform"}};

}  // namespace

std::string synonym_hint(std::string_view key, const std::vector<std::string>& known) {
  for (const auto& [elsewhere, here] : synonyms) {
    if (key != elsewhere || std::find(known.begin(), known.end(), here) == known.end()) continue;
    if (here != "transform") return "; here it is '" + std::string(here) + "'";
    const std::string step = key == "scale"                         ? "scale"
                             : key == "rotate" || key == "rotation" ? "rotate"
                                                                    : "translate";
    return "; put it in transform: [{" + step + ": ...}]";
  }
  return "";
}

}  // namespace pah
