// scenes/pahrender.schema.json and the parser describe the same language.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "catch.hpp"
#include "json_schema.hpp"
#include "load/scene/language.hpp"
#include "scene_testing.hpp"
#include "support/paths.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;
using Json = nlohmann::json;

namespace {

const Json& schema() {
  static const Json json =
      Json::parse(std::ifstream(test::source_folder() / "scenes" / "pahrender.schema.json"));
  return json;
}

std::string underscored(std::string kind) {
  std::replace(kind.begin(), kind.end(), ' ', '_');
  return kind;
}

// Returns the JSON type. Numbers and lists that keyframes may replace are references to
// definitions.
std::string type_of(const Json& property) {
  const std::string prefix = "#/$defs/";
  const std::string reference = property.value("$ref", prefix);
  const std::string name = reference.substr(prefix.size());
  if (name == "list") return "array";
  return name == "number" || name == "integer" ? name : property.value("type", "");
}

// Returns the words that a property allows, alone or in a list.
std::vector<std::string> options_of(const Json& property) {
  if (property.contains("const")) return {property["const"]};
  if (property.contains("enum")) return property["enum"];
  if (property.contains("items") && property["items"].contains("enum"))
    return property["items"]["enum"];
  return {};
}

// Returns the language of a schema in the form of describe_language().
Language language_of(const Json& definitions) {
  Language language;
  for (const auto& [name, definition] : definitions.items()) {
    if (!definition.contains("properties")) continue;
    auto& keys = language[name];
    const auto required = definition.value("required", std::vector<std::string>());
    for (const auto& [key, property] : definition["properties"].items())
      keys[key] = {std::find(required.begin(), required.end(), key) != required.end(),
                   options_of(property)};
  }
  return language;
}

// Writes one line for each key, for comparison as text.
std::vector<std::string> lines_of(const Language& language) {
  std::vector<std::string> lines;
  for (const auto& [kind, keys] : language)
    for (const auto& [key, description] : keys) {
      std::string line = underscored(kind) + " " + key;
      if (description.required) line += " required";
      for (const std::string& option : description.options) line += " " + option;
      lines.push_back(line);
    }
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Returns a scene that uses the map `value`, whose kind `name` defines.
std::optional<Json> scene_with(const std::string& name, const Json& value) {
  const auto is = [&](const char* prefix) { return name.starts_with(prefix); };
  const auto box = [](const char* key, const Json& item) {
    return Json{{"meshes", {Json{{"shape", "box"}, {key, item}}}}};
  };
  const auto material = [](const char* key, const Json& item) {
    return Json{{"textures", {{"t", {{"type", "checker"}}}}},
                {"materials", {{"m", {{"type", "glass"}, {key, item}}}}}};
  };
  if (is("camera_")) return Json{{"camera", value}};
  if (is("film") || is("render") || is("acceleration") || is("animation"))
    return Json{{name, value}};
  if (is("filter")) return Json{{"film", {{"filter", value}}}};
  if (is("texture_")) return Json{{"textures", {{"t", value}}}};
  if (is("material_")) return Json{{"materials", {{"m", value}}}};
  if (is("color_texture")) return material("reflectance", value);
  if (is("scalar_texture")) return material("roughness", value);
  if (is("normal_texture")) return material("normal_map", value);
  if (is("mesh_")) return Json{{"meshes", {value}}};
  if (is("light_")) return Json{{"lights", {value}}};
  if (is("rotate") || is("look_at")) return box("transform", {{name, value}});
  if (is("transform")) return box("transform", value);
  if (is("repeat_")) return box("repeat", value);
  if (is("scatter")) return box("scatter", value);
  if (is("influence_area_plane"))
    return Json{{"camera", {{"type", "orthographic"}}}, {"influence_areas", {value}}};
  if (is("influence_area_point")) return Json{{"influence_areas", {value}}};
  return {};
}

// Returns a value that a property allows.
Json some_value(const std::string& key, const Json& property) {
  if (property.contains("const")) return property["const"];
  if (property.contains("enum")) return property["enum"][0];
  if (property.contains("default")) return property["default"];
  if (key == "light") return "camera";
  if (key == "file") return "picture.tga";
  if (key == "texture") return "t";
  if (key == "axis") return "x";
  if (type_of(property) == "array") {
    Json list = Json::array();
    for (int i = 0; i < property.value("minItems", 1); ++i)
      list.push_back(property["items"].value("minimum", i + 1));
    return list;
  }
  return 1;
}

// Returns values at and beyond the limits of a property's range.
std::vector<Json> border_values(const std::string& key, const Json& property) {
  std::vector<Json> values;
  if (property.contains("default")) values.push_back(property["default"]);
  for (const std::string& option : options_of(property)) values.emplace_back(option);
  if (!options_of(property).empty()) values.push_back("zzz");
  const std::string type = type_of(property);
  if (type == "boolean") values.insert(values.end(), {true, false, "perhaps", 1});
  if (type == "integer" || type == "number") {
    values.insert(values.end(), {"text", Json::array({1})});
    if (property.contains("$ref") && property.contains("default")) {
      const Json& usual = property["default"];
      values.push_back(usual.dump() + " + frame");
      values.push_back({{"keys", {{"0", usual}, {"9.5", usual}}}, {"interpolation", "smooth"}});
    }
    if (type == "integer") values.push_back(1.5);
    for (const char* bound : {"minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"})
      if (property.contains(bound) && !(key == "count" && bound == std::string("maximum"))) {
        const auto value = property[bound].get<double>();
        const bool low = bound[0] == 'm' ? bound[1] == 'i' : bound[10] == 'i';
        values.push_back(property[bound]);
        values.push_back(low ? value - 1 : value * 2 + 1);
      }
  }
  if (key == "memory")
    values.insert(values.end(), {"2 GiB", "512mb", "1.5  Tb", "0.5 KiB", "3. B", "99999999999 TB",
                                 "0 B", "0.0 MB", "-1 GiB", "+1 GiB", "2", "GiB", "1e3 MB", "2 GX",
                                 "2 iB", "2 GiB ", "", 2});
  if (type == "array" && property.contains("minItems")) {
    const Json list = some_value("", property);
    values.push_back(list);
    if (property.contains("$ref"))
      values.push_back({{"keys", {{"0", list}, {"9.5", list}}}, {"interpolation", "smooth"}});
    values.push_back(1);
    for (const Json& item : border_values(key, property["items"])) {
      Json changed = list;
      changed.back() = item;
      values.push_back(changed);
    }
    Json shorter = list;
    shorter.erase(0);
    values.push_back(shorter);
  }
  return values;
}

}  // namespace

TEST_CASE("Schema and parser know the same keys, requirements and options") {
  const std::vector<std::string> of_schema = lines_of(language_of(schema()["$defs"]));
  const std::vector<std::string> of_parser = lines_of(describe_language());
  CHECK(of_schema.size() > 200);
  std::vector<std::string> only_schema, only_parser;
  std::set_difference(of_schema.begin(), of_schema.end(), of_parser.begin(), of_parser.end(),
                      std::back_inserter(only_schema));
  std::set_difference(of_parser.begin(), of_parser.end(), of_schema.begin(), of_schema.end(),
                      std::back_inserter(only_parser));
  CHECK(only_schema == std::vector<std::string>());
  CHECK(only_parser == std::vector<std::string>());
}

TEST_CASE("A superfluous key, option or requirement is found") {
  const auto before = lines_of(describe_language());
  Json changed = schema()["$defs"];
  SECTION("key") { changed["film"]["properties"]["depth"] = {{"type", "integer"}}; }
  SECTION("option") { changed["render"]["properties"]["strategy"]["enum"].push_back("vcm"); }
  SECTION("requirement") { changed["film"]["required"] = {"width"}; }
  SECTION("none left") { changed["material_glass"]["properties"].erase("ior"); }
  CHECK(lines_of(language_of(changed)) != before);
}

TEST_CASE("Schema and parser accept the same values") {
  const JsonSchema validator(schema());
  const TemporaryFolder folder;
  write_text(folder / "picture.tga", test::tga(2, 2, "twelve bytes"));
  int probes = 0;
  for (const auto& [name, definition] : schema()["$defs"].items()) {
    if (!definition.contains("properties") || name.ends_with("_file")) continue;
    Json base = Json::object();
    for (const std::string key : definition.value("required", Json::array()))
      base[key] = some_value(key, definition["properties"][key]);
    if (definition.contains("oneOf")) {  // exactly one of several keys is required
      const std::string key = definition["oneOf"].back()["required"][0];
      base[key] = key == "image" ? Json("picture.tga") : Json::parse("[[1, 2], [3, 4]]");
    }
    for (const auto& [key, property] : definition["properties"].items()) {
      if (key == "crop" || key == "matrix") continue;  // their numbers depend on each other
      for (const Json& value : border_values(key, property)) {
        Json map = name == "transform" ? Json::object() : base;
        map[key] = value;
        const auto scene = scene_with(name, map);
        if (!scene) continue;
        ++probes;
        // Expressions are unquoted scalars in YAML.
        const std::string text =
            std::regex_replace(scene->dump(), std::regex("\"([^\"]* \\+ frame)\""), "$1");
        INFO(text);
        std::string errors;
        try {
          (void)load_scene(write_text(folder / "scene.yaml", text));
        } catch (const SceneError& error) {
          errors = error.what();
        }
        INFO(errors);
        CHECK(validator.accepts(*scene) == errors.empty());
      }
    }
  }
  CHECK(probes > 500);
}
