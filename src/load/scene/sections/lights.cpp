// The lights section.
#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

void read_radiometry(MapReader& map, std::string_view key, Vec3& value) {
  if (const YamlNode* node = map.find(key))
    read_color(map.context(), *node, map.name_of(key), value);
}

// Returns false if the key is absent.
bool read_direction(MapReader& map, DVec3& direction) {
  const bool given = map.optional("direction", direction);
  if (given && direction == DVec3(0))
    map.error("direction", map.name_of("direction") + " must not be zero");
  return given;
}

PointLight read_point(MapReader& map) {
  PointLight light;
  map.optional("position", light.position);
  read_radiometry(map, "intensity", light.intensity);
  return light;
}

SpotLight read_spot(MapReader& map) {
  SpotLight light;
  map.optional("position", light.position);
  if (!read_direction(map, light.direction) && !map.recording())
    map.context().errors.warn(map.mark(), map.title() + " has no direction; it shines down");
  read_radiometry(map, "intensity", light.intensity);
  map.optional("angle", light.angle, NumberRange{0, 90, true, false});
  map.optional("blend", light.blend, unit_range);
  return light;
}

DirectionalLight read_directional(MapReader& map) {
  DirectionalLight light;
  (void)read_direction(map, light.direction);
  read_radiometry(map, "irradiance", light.irradiance);
  map.optional("angle", light.angle, NumberRange{0, 90, false, false});
  return light;
}

AreaLight read_area(MapReader& map) {
  AreaLight light;
  read_radiometry(map, "radiance", light.radiance);
  map.optional("two_sided", light.two_sided);
  return light;
}

EnvironmentLight read_environment(SceneReading& reading, MapReader& map) {
  EnvironmentLight light;
  read_radiometry(map, "radiance", light.radiance);
  if (const YamlNode* image = map.find("image"))
    light.image = image_texture(reading, *image, map.name_of("image"), ColorSpace::automatic)
                      .value_or(no_texture);
  map.nested("rotate", [&](const YamlNode* node) {
    light.world_from_light = read_rotation(reading.context, node, map.name_of("rotate"));
  });
  return light;
}

void read_light(SceneReading& reading, const YamlNode* node, const std::string& title) {
  read_variant(
      reading.context, node, "light", title, "type",
      {"point", "spot", "directional", "area", "environment"}, 5,
      [&](MapReader& map, std::size_t type) {
        Scene& scene = reading.scene;
        const auto id = static_cast<LightId>(scene.lights.size());
        Light light;
        const bool named = map.optional("name", light.name);
        if (!named) light.name = title;
        if (named && light.name == "camera")
          map.error(
              "name",
              "a light cannot be named 'camera': influence areas use this name for the camera");
        if (type == 0) light.model = read_point(map);
        if (type == 1) light.model = read_spot(map);
        if (type == 2) light.model = read_directional(map);
        if (type == 3) light.model = read_area(map);
        if (type == 4) light.model = read_environment(reading, map);
        const std::string name = light.name;
        scene.lights.push_back(std::move(light));
        if (named) reading.lights.add(reading.context, name, id, map.mark_of("name"));
        if (type != 3) return;
        GeometryUse use{name, read_material_name(reading, map), id};
        // Without a material, an area light reflects nothing.
        if (!use.material && !map.recording()) use.material = unnamed_material(reading, 0);
        read_geometry(reading, map, use);
      });
}

}  // namespace

void read_lights(SceneReading& reading, const YamlNode* node) {
  if (node == nullptr) return read_light(reading, nullptr, "light");
  if (!is_list(reading.context, *node, "lights")) return;
  for (std::size_t i = 0; i < node->items.size(); ++i)
    read_light(reading, node->items[i].get(), title_of(*node->items[i], "light", i));
}

}  // namespace pah
