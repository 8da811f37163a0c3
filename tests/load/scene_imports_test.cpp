// Scenes that use and adjust the content of mesh files.
#include <pah/image/image_file.hpp>
#include <pah/load/load_scene.hpp>

#include "catch.hpp"
#include "scene_testing.hpp"

using namespace pah;

namespace {

// A painted triangle, an emissive triangle, two cameras and a point light.
constexpr const char* kitchen = R"({
  "asset": {"version": "2.0"},
  "nodes": [{"mesh": 0}, {"camera": 0, "name": "wide", "translation": [0, 0, 3]},
            {"camera": 1, "name": "close", "translation": [0, 0, 1]},
            {"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}}}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
              {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 1366}]}},
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
                             {"attributes": {"POSITION": 0}, "material": 1}]}],
  "materials": [{"name": "paint"}, {"name": "glow", "emissiveFactor": [1, 1, 1]}],
  "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})";

class Kitchen {
 public:
  Kitchen() { write("kitchen.gltf", kitchen); }

  void write(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
  }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return folder_ / name;
  }

  [[nodiscard]] Scene load(const std::string& yaml,
                           const std::vector<std::string>& overrides = {}) const {
    return load_scene(write_text(folder_ / "scene.yaml", yaml), {overrides, {}}).scene;
  }
  [[nodiscard]] std::string error_of(const std::string& yaml) const {
    try {
      (void)load(yaml);
    } catch (const SceneError& error) {
      const LocatedError& first = error.errors().front();
      return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + ": " +
             first.message;
    }
    return "";
  }

 private:
  TemporaryFolder folder_;
};

const PerspectiveCamera& camera_of(const Scene& scene) {
  return std::get<PerspectiveCamera>(scene.camera);
}

}  // namespace

TEST_CASE("A mesh file's camera is chosen by name and adjusted") {
  const Kitchen files;
  const std::string first = "meshes: [{file: kitchen.gltf, use: [cameras]}]\n";
  const std::string close = "meshes: [{file: kitchen.gltf, use: [cameras], use_camera: close}]\n";
  CHECK(camera_of(files.load(first)).position == DVec3(0, 0, 3));
  CHECK(camera_of(files.load(close)).position == DVec3(0, 0, 1));
  const Scene scene = files.load(close + "camera: {aperture_radius: 0.25, focus_distance: 2}\n");
  CHECK(camera_of(scene).position == DVec3(0, 0, 1));
  CHECK(camera_of(scene).fov == Approx(0.5 * 180 / 3.14159265));
  CHECK(camera_of(scene).aperture_radius == 0.25);
  CHECK(camera_of(scene).focus_distance == 2);
  CHECK(camera_of(files.load(first, {"camera.fov=20"})).fov == 20);

  CHECK(files.error_of("meshes: [{file: kitchen.gltf, use: [cameras], use_camera: closer}]") ==
        "1:59: the mesh file has no camera 'closer'; did you mean 'close'? Available options are: "
        "wide, close");
  CHECK(files.error_of("meshes: [{file: kitchen.gltf, use_camera: close}]") ==
        "1:43: 'use_camera' needs the file's cameras: use: [cameras]");
  CHECK(files.error_of("camera: {position: [1, 2, 3]}\n" + first) ==
        "2:36: the scene has a camera already: beside a mesh file's, 'camera' may have fov, "
        "aperture_radius and focus_distance");
}

TEST_CASE("A mesh file's lights are scaled") {
  const Kitchen files;
  const Scene scene =
      files.load("meshes: [{file: kitchen.gltf, use: [materials, lights], light_scale: 0.5}]");
  REQUIRE(scene.lights.size() == 2);
  CHECK(std::get<PointLight>(scene.lights[0].model).intensity.x == Approx(1));
  CHECK(std::get<AreaLight>(scene.lights[1].model).radiance.x == Approx(0.5));
  CHECK(files.error_of("meshes: [{file: kitchen.gltf, light_scale: 2}]") ==
        "1:44: 'light_scale' needs the file's lights: use: [lights]");
}

TEST_CASE("A mesh file's emissive texture and double-sidedness come with its light") {
  const Kitchen files;
  std::string text = kitchen;
  const std::string factor = R"("emissiveFactor")";
  text.replace(text.find(factor), factor.size(),
               R"("doubleSided": true, "emissiveTexture": {"index": 0}, "emissiveFactor")");
  text.insert(text.find(R"("materials")"),
              R"("images": [{"uri": "glow.png"}], "textures": [{"source": 0}], )");
  files.write("kitchen.gltf", text);
  write_image(files / "glow.png", {{"", {"R", "G", "B"}, {1, 1, {Vec3(1)}}}});
  const Scene scene = files.load(
      "textures: {squares: {type: checker}}\n"
      "materials: {m: {type: diffuse, reflectance: {texture: squares}}}\n"
      "meshes: [{shape: box, material: m}, {file: kitchen.gltf, use: [materials, lights]}]");
  const auto& glow = std::get<AreaLight>(scene.lights.at(1).model);
  CHECK(glow.two_sided);
  CHECK(std::get<ImageTexture>(scene.textures.at(glow.image)).file.filename() == "glow.png");
}

TEST_CASE("A mesh file's materials are replaced by name") {
  const Kitchen files;
  const std::string start = "materials: {m: {type: mirror}}\nmeshes: [{file: kitchen.gltf, ";
  const Scene scene = files.load(start + "use: [materials], replace: {paint: m}}]");
  REQUIRE(scene.instances.size() == 2);
  CHECK(scene.materials[scene.instances[0].material].name == "m");
  CHECK(scene.materials[scene.instances[1].material].name == "glow");
  CHECK(files.error_of(start + "use: [materials], replace: {point: m}}]") ==
        "2:59: the mesh file uses no material 'point'; did you mean 'paint'? Available options "
        "are: glow, paint");
  CHECK(files.error_of(start + "use: [materials], replace: {paint: n}}]") ==
        "2:66: unknown material 'n' in 'replace' of mesh 1; did you mean 'm'?");
  CHECK(files.error_of(start + "replace: {paint: m}}]") ==
        "2:40: 'replace' needs the file's materials: use: [materials]");
}
