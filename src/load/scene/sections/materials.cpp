// The materials section.
#include <pah/scene/metal_presets.hpp>

#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

void read_model(SceneReading& reading, MapReader& map, DiffuseMaterial& material) {
  read_input(reading, map, "reflectance", material.reflectance, unit_range);
}

void read_model(SceneReading& reading, MapReader& map, MirrorMaterial& material) {
  read_input(reading, map, "reflectance", material.reflectance, unit_range);
}

void read_model(SceneReading& reading, MapReader& map, GlassMaterial& material) {
  map.optional("ior", material.ior, positive);
  read_input(reading, map, "roughness", material.roughness, unit_range);
  read_input(reading, map, "reflectance", material.reflectance, unit_range);
  read_input(reading, map, "transmittance", material.transmittance, unit_range);
}

void read_model(SceneReading& reading, MapReader& map, MetalMaterial& material) {
  EnumNames<const MetalPreset*> names;
  for (const MetalPreset& preset : metal_presets()) names.emplace_back(preset.name, &preset);
  for (const MetalPreset& preset : metal_presets()) names.emplace_back(preset.english, &preset);
  const MetalPreset* preset = nullptr;
  map.option("preset", preset, names);
  if (preset != nullptr) {
    material.eta = preset->eta;
    material.k = preset->k;
  }
  for (auto [key, value, range] :
       {std::tuple{"eta", &material.eta, positive}, {"k", &material.k, not_negative}}) {
    const YamlNode* node = map.find(key);
    if (node == nullptr) continue;
    if (preset != nullptr) map.error(key, map.title() + " takes either 'preset' or 'eta' and 'k'");
    read_color(reading.context, *node, map.name_of(key), *value, range);
  }
  read_input(reading, map, "roughness", material.roughness, unit_range);
  read_input(reading, map, "tint", material.tint, unit_range);
}

void read_model(SceneReading& reading, MapReader& map, PlasticMaterial& material) {
  read_input(reading, map, "reflectance", material.reflectance, unit_range);
  map.optional("ior", material.ior, positive);
  read_input(reading, map, "roughness", material.roughness, unit_range);
}

void read_model(SceneReading& reading, MapReader& map, PrincipledMaterial& material) {
  read_input(reading, map, "base_color", material.base_color, unit_range);
  read_input(reading, map, "metallic", material.metallic, unit_range);
  read_input(reading, map, "roughness", material.roughness, unit_range);
  map.optional("ior", material.ior, positive);
}

// The names of the types, and their defaults in the same order.
const std::vector<std::string> type_names{"diffuse", "mirror",  "glass",
                                          "metal",   "plastic", "principled"};
const std::vector<MaterialModel> type_defaults{DiffuseMaterial{}, MirrorMaterial{},
                                               GlassMaterial{},   MetalMaterial{},
                                               PlasticMaterial{}, PrincipledMaterial{}};

Material read_material(SceneReading& reading, const YamlNode* node, const std::string& name) {
  Material material;
  material.name = name;
  const std::string title = "material '" + name + "'";
  read_variant(reading.context, node, "material", title, "type", type_names, type_names.size(),
               [&](MapReader& map, std::size_t type) {
                 material.model = type_defaults[type];
                 std::visit([&](auto& model) { read_model(reading, map, model); }, material.model);
                 read_normal_map(reading, map, "normal_map", material.normal_map);
                 read_input(reading, map, "opacity", material.opacity, unit_range);
               });
  return material;
}

}  // namespace

void read_materials(SceneReading& reading, const YamlNode* node) {
  if (node == nullptr) {
    (void)read_material(reading, nullptr, "");
    return;
  }
  if (!is_map(reading.context, node, "materials")) return;
  for (const YamlEntry& entry : node->entries) {
    reading.scene.materials.push_back(read_material(reading, entry.value.get(), entry.key));
    reading.materials.add(reading.context, entry.key,
                          static_cast<MaterialId>(reading.scene.materials.size() - 1), entry.mark);
  }
}

}  // namespace pah
