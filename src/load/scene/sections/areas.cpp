// The influence_areas section.
#include <pah/scene/areas.hpp>

#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

BundleShape shape_of(const Scene& scene, std::optional<LightId> light) {
  return light ? bundle_shape(scene.lights[*light]) : bundle_shape(scene.camera);
}

bool read_light_name(SceneReading& reading, MapReader& map, std::string& name, BundleShape wanted) {
  const YamlNode* node = map.find("light", true);
  if (node == nullptr) return false;
  std::optional<LightId> light;
  if (node->kind != Kind::scalar || node->text != "camera") {
    light = reading.lights.find(reading.context, *node, map.name_of("light"));
    if (!light) return false;
  }
  name = node->text;
  if (shape_of(reading.scene, light) == wanted) return true;
  map.error("light", "the rays of '" + name + "' " +
                         (wanted == BundleShape::point
                              ? "do not meet in a point: a point area takes a point or spot light, "
                                "or a perspective camera without an aperture"
                              : "are not parallel: a plane area takes a directional light or an "
                                "orthographic camera"));
  return false;
}

void read_nonzero(MapReader& map, std::string_view key, DVec3& value) {
  if (map.optional(key, value) && value == DVec3(0))
    map.error(key, map.name_of(key) + " must not be zero");
}

PlaneAreaDeclaration read_plane(SceneReading& reading, MapReader& map) {
  PlaneAreaDeclaration area;
  read_light_name(reading, map, area.light, BundleShape::parallel);
  map.optional("position", area.position);
  read_nonzero(map, "direction", area.direction);
  map.optional("size", area.size, positive);
  map.optional("depth", area.depth, positive);
  return area;
}

PointAreaDeclaration read_point(SceneReading& reading, MapReader& map) {
  PointAreaDeclaration area;
  read_light_name(reading, map, area.light, BundleShape::point);
  read_nonzero(map, "forward", area.forward);
  map.optional("fov", area.fov, NumberRange{0, 180, true, true});
  map.optional("near", area.near, not_negative);
  const bool has_far = map.optional("far", area.far, positive);
  if (area.near >= area.far)
    map.error(has_far ? "far" : "near", map.name_of("near") + " must be less than 'far'");
  return area;
}

void read_area(SceneReading& reading, const YamlNode* node, const std::string& title) {
  read_variant(reading.context, node, "influence_area", title, "type", {"plane", "point"}, 2,
               [&](MapReader& map, std::size_t type) {
                 auto& declared = reading.scene.influence_areas.declared;
                 if (type == 0)
                   declared.emplace_back(read_plane(reading, map));
                 else
                   declared.emplace_back(read_point(reading, map));
               });
}

}  // namespace

void read_influence_areas(SceneReading& reading, const YamlNode* node) {
  InfluenceSettings& settings = reading.scene.influence_areas;
  if (node == nullptr) {
    read_area(reading, nullptr, "influence area");
    settings = {};
    return;
  }
  if (node->kind != Kind::list) {
    const std::size_t index =
        read_option(reading.context, *node, "'influence_areas' of the scene", {"auto", "off"});
    settings.derive = index == 0;
    return;
  }
  settings.derive = false;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const YamlNode& item = *node->items[i];
    if (item.kind == Kind::scalar) {
      if (read_option(reading.context, item, "'influence area' of the scene", {"auto"}) == 0)
        settings.derive = true;
    } else {
      read_area(reading, &item, "influence area " + std::to_string(i + 1));
    }
  }
}

}  // namespace pah
