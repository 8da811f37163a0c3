// Typical mistakes of beginners and the messages for them.
#include <pah/load/load_scene.hpp>

#include "catch.hpp"
#include "scene_faults.hpp"

using namespace pah;

TEST_CASE("Mistakes in YAML get helpful messages") {
  check_all({
      {"film:\n\twidth: 4\n",
       "scene.yaml:2:1: error: lines are indented by spaces here, not by tabs"},
      {"film:\n  width: 4\n   height: 3\n",
       "scene.yaml:3:10: error: not valid YAML: illegal map value; is the line indented like those "
       "beside it?"},
      {"camera: {position: [0, 1, 2, look_at: [0, 0, 0]}\nfilm: {width: 3}\n",
       "scene.yaml:1:20: error: the '[' here is not closed"},
      {"film:\n  filter: {type: box\nrender: {samples: 4}\n",
       "scene.yaml:2:11: error: the '{' here is not closed"},
      {"materials: {m: {type: diffuse, reflectance: #ff8800}}\n",
       "scene.yaml:1:45: error: not valid YAML; a '#' after a blank begins a comment: write "
       "\"#ff8800\" in quotes"},
      {"materials:\n  m:\n    type: diffuse\n    reflectance: #ff8800\n",
       "scene.yaml:4:5: error: 'reflectance' of material 'm' must be a color ([r, g, b], a number "
       "or "
       "\"#rrggbb\"), not nothing; a '#' after a blank begins a comment: write \"#ff8800\" in "
       "quotes"},
      {"render:\n  samples:4\n",
       "scene.yaml:2:3: error: render must be a map, not 'samples:4'; a blank is missing after the "
       "colon"},
      {"render: {samples:4}\n",
       "scene.yaml:1:10: error: unknown key 'samples:4' in render; a blank is missing after the "
       "colon"},
      {"textures: {t: {type: image, file: \"tex\\wood.png\"}}\n",
       "scene.yaml:1:41: error: in double quotes a backslash begins an escape: write / or use "
       "single "
       "quotes"},
      {"\xFF\xFEm", "scene.yaml:1:1: error: this is UTF-16: save the text as UTF-8"},
  });
}

TEST_CASE("Mistakes in keys and values get helpful messages") {
  check_all({
      {"lights: [{position: [0, 1, 0]}]",
       "scene.yaml:1:10: error: missing key 'type' in light 1; available options are: point, spot, "
       "directional, area, environment"},
      {"lights: [{typ: point}]",
       "scene.yaml:1:10: error: missing key 'type' in light 1; is 'typ' meant to be 'type'?"},
      {"materials: {m: {type: diffuse, reflectance: wood.png}}",
       "scene.yaml:1:45: error: 'reflectance' of material 'm' must be a color ([r, g, b], a number "
       "or \"#rrggbb\"), not 'wood.png'; a picture is {image: wood.png}"},
      {"meshes: [{shape: box, translate: [0, 1, 0]}]",
       "scene.yaml:1:23: error: unknown key 'translate' in mesh 1; put it in transform: "
       "[{translate: ...}]"},
      {"meshes: [{shape: box, rotation: 30}]",
       "scene.yaml:1:23: error: unknown key 'rotation' in mesh 1; put it in transform: "
       "[{rotate: ...}]"},
      {"lights: [{type: point, power: 100}]",
       "scene.yaml:1:24: error: unknown key 'power' in light 1; here it is 'intensity'"},
      {"lights: [{type: directional, color: 1}]",
       "scene.yaml:1:30: error: unknown key 'color' in light 1; here it is 'irradiance'"},
      {"materials: {m: {type: principled, color: 1}}",
       "scene.yaml:1:35: error: unknown key 'color' in material 'm'; here it is 'base_color'"},
      {"camera: {focal_length: 50}",
       "scene.yaml:1:10: error: unknown key 'focal_length' in camera; here it is 'fov'"},
      {"camera: {target: [0, 0, 0]}",
       "scene.yaml:1:10: error: unknown key 'target' in camera; here it is 'look_at'"},
      {"meshes: [{shape: box, scatter: {count: 3, over: floor}}, {name: floor, shape: rectangle}]",
       "scene.yaml:1:49: error: unknown mesh 'floor' in 'over' of scatter of mesh 1; there are "
       "none: "
       "a mesh must come before the meshes that name it"},
      {"materials: {m: {type: diffuse, reflectance: [255, 0, 1]}}",
       "scene.yaml:1:45: error: 'reflectance' of material 'm' goes from 0 to 1: divide by 255, or "
       "write \"#rrggbb\"\n"
       "scene.yaml:1:46: error: 'reflectance' of material 'm' must be between 0 and 1, not 255"},
  });
  const Scene gold = load("materials: {m: {type: metal, preset: gold}}").scene;
  const Scene au = load("materials: {m: {type: metal, preset: Au}}").scene;
  CHECK(std::get<MetalMaterial>(gold.materials[0].model).k ==
        std::get<MetalMaterial>(au.materials[0].model).k);
}

TEST_CASE("Files that are not scenes are refused") {
  const TemporaryFolder folder;
  const auto error_of = [&](const char* name) {
    try {
      (void)load_scene(write_text(folder / name, "v 0 0 0\n"));
    } catch (const SceneError& error) {
      return error.errors().front().message;
    }
    return std::string();
  };
  CHECK(error_of("bunny.OBJ") ==
        "this is a mesh file; a scene that shows it says: meshes: [{file: bunny.OBJ}]");
  CHECK(error_of("old.pov") == "scenes of other programs cannot be read; a scene is a YAML file");
}

TEST_CASE("Scenes with likely mistakes get warnings") {
  const auto warnings = [](const std::string& text) {
    std::string result;
    for (const LocatedError& warning : load(text).warnings)
      result += std::to_string(warning.where.line) + ":" + std::to_string(warning.where.column) +
                ": " + warning.message + "\n";
    return result;
  };
  const std::string box = "meshes: [{shape: box}]\n";
  const std::string bulb = "lights: [{type: point}]\n";
  CHECK(warnings(box + bulb) == "");
  CHECK(warnings(box) == "0:0: the scene has no light: the picture will be black\n");
  CHECK(warnings(bulb) == "0:0: the scene has no mesh: the picture will be empty\n");
  CHECK(warnings(box + bulb + "camera: {fov: 0.8}\n") ==
        "3:15: 'fov' is in degrees, and this is very narrow\n");
  CHECK(warnings(box + "lights: [{type: spot}]") ==
        "2:10: light 1 has no direction; it shines down\n");
  CHECK(warnings("meshes: [{shape: box, scatter: {count: 50, min_distance: 3, size: [4, 4]}}]\n" +
                 bulb) == "1:40: only 3 of 50 copies fit at this 'min_distance'\n");
  CHECK(warnings("meshes: [{shape: box, scatter: {count: 5, size: [4, 4]}}]\n" + bulb) == "");
}
