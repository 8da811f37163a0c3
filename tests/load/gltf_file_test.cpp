#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pah/load/mesh_file.hpp>

#include "support/mesh_checks.hpp"
#include "support/mutate.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using Json = nlohmann::json;

namespace {

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Positions, normals and texture coordinates of a square in the xy plane, then indices.
std::string square_bytes() {
  std::string bytes;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
    append(bytes, p);
  for (int i = 0; i < 4; ++i) append(bytes, Vec3(0, 0, 1));
  for (const Vec2& uv : {Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 0}}) append(bytes, uv);
  for (const std::uint16_t i : {0, 1, 2, 0, 2, 3}) append(bytes, i);
  return bytes;
}

Json square() {
  return Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "name": "square"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                                "indices": 3, "material": 0}]}],
    "materials": [{"name": "paint", "pbrMetallicRoughness":
        {"baseColorFactor": [0.1, 0.2, 0.3, 0.5], "metallicFactor": 0.25, "roughnessFactor": 0.75}}],
    "buffers": [{"byteLength": 140, "uri": "square.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 128}, {"buffer": 0, "byteOffset": 128,
                                                       "byteLength": 12}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 4, "type": "VEC2"},
      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})");
}

class Files {
 public:
  Files() { write("square.bin", square_bytes()); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  [[nodiscard]] std::filesystem::path write(const Json& json) const {
    return write("square.gltf", json.dump(1));
  }
  // As binary glTF, the buffer inside.
  [[nodiscard]] std::filesystem::path write_binary(Json json) const {
    json["buffers"][0].erase("uri");
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string data = square_bytes();
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(28 + text.size() + data.size()));
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    append(bytes, static_cast<std::uint32_t>(data.size()));
    bytes += std::string("BIN\0", 4) + data;
    return write("square.glb", bytes);
  }
  [[nodiscard]] std::string error_of(const Json& json) const { return error_of(write(json)); }
  [[nodiscard]] static std::string error_of(const std::filesystem::path& file) {
    try {
      (void)read_mesh_file(file);
    } catch (const MeshFileError& e) {
      return e.what();
    }
    return "";
  }

 private:
  TemporaryFolder folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A glTF square loads from text and from binary") {
  const Files files;
  for (const auto& file : {files.write(square()), files.write_binary(square())}) {
    CAPTURE(file);
    const Mesh mesh = read_mesh(file);
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.positions.size() == 4);
    CHECK(area_of(mesh) == Approx(1));
    for (const Vec3& n : mesh.normals) CHECK(n == Vec3(0, 0, 1));
    // glTF's v grows downwards, ours upwards.
    for (std::size_t i = 0; i < 4; ++i) CHECK(mesh.uvs[i] == Vec2(mesh.positions[i]));

    const MeshFile whole = read_mesh_file(file);
    REQUIRE(whole.parts.size() == 1);
    const Material& material = whole.materials[whole.parts[0].material];
    CHECK(material.name == "paint");
    REQUIRE(std::holds_alternative<PrincipledMaterial>(material.model));
    const auto& model = std::get<PrincipledMaterial>(material.model);
    CHECK(model.base_color.value == Vec3(0.1F, 0.2F, 0.3F));
    CHECK(model.metallic.value == 0.25F);
    CHECK(model.roughness.value == 0.75F);
    CHECK(material.opacity.value == 1);  // OPAQUE ignores alpha
  }
}

TEST_CASE("glTF nodes transform and repeat meshes") {
  const Files files;
  Json json = square();
  json["nodes"] = Json::parse(R"([
    {"children": [1, 2], "translation": [10, 0, 0]},
    {"mesh": 0, "scale": [2, 3, 1]},
    {"mesh": 0, "translation": [0, 0, 5], "scale": [-1, 1, 1]}])");
  const auto file = files.write(json);
  const Mesh mesh = read_mesh(file);
  CHECK(mesh.triangles.size() == 4);
  CHECK(area_of(mesh) == Approx(7));
  for (std::size_t t = 0; t < 4; ++t) {
    const UVec3& k = mesh.triangles[t];
    const Vec3 a = mesh.positions[k.x];
    CHECK(a.x >= 9);
    CHECK(a.z == (t < 2 ? 0 : 5));
    // The mirrored one is turned over and keeps its face to +z.
    CHECK(glm::cross(mesh.positions[k.y] - a, mesh.positions[k.z] - a).z > 0);
  }
  const MeshFile whole = read_mesh_file(file);
  CHECK(whole.meshes.size() == 1);
  REQUIRE(whole.parts.size() == 2);
  CHECK(whole.parts[1].world_from_object[3] == DVec3(10, 0, 5));
}

TEST_CASE("glTF cameras and lights load") {
  const Files files;
  Json json = square();
  json["extensionsUsed"] = {"KHR_lights_punctual"};
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
    {"type": "point", "color": [1, 0.5, 0.25], "intensity": 683},
    {"type": "directional", "intensity": 1366},
    {"type": "spot", "intensity": 683,
     "spot": {"innerConeAngle": 0.2617993878, "outerConeAngle": 0.5235987756}}])");
  json["cameras"] = Json::parse(R"([
    {"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}},
    {"type": "orthographic",
     "orthographic": {"xmag": 4, "ymag": 2, "znear": 0.1, "zfar": 10}}])");
  // Half a turn about y: what looked along -z looks along +z.
  json["nodes"] = Json::parse(R"([
    {"mesh": 0},
    {"camera": 0, "name": "eye", "translation": [1, 2, 3], "rotation": [0, 1, 0, 0]},
    {"camera": 1, "name": "plan", "translation": [0, 9, 0]},
    {"name": "bulb", "translation": [0, 4, 0],
     "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "sun", "rotation": [0, 1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}},
    {"name": "spot", "translation": [5, 0, 0],
     "extensions": {"KHR_lights_punctual": {"light": 2}}}])");
  json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
  const MeshFile file = read_mesh_file(files.write(json));

  REQUIRE(file.cameras.size() == 2);
  CHECK(file.cameras[0].name == "eye");
  const auto& eye = std::get<PerspectiveCamera>(file.cameras[0].camera);
  CHECK(eye.fov == Approx(0.5 * 180 / 3.14159265358979));
  CHECK(glm::distance(eye.position, DVec3(1, 2, 3)) < 1e-6);
  CHECK(glm::distance(glm::normalize(eye.look_at - eye.position), DVec3(0, 0, 1)) < 1e-6);
  CHECK(glm::distance(glm::normalize(eye.up), DVec3(0, 1, 0)) < 1e-6);
  REQUIRE(std::holds_alternative<OrthographicCamera>(file.cameras[1].camera));
  CHECK(std::get<OrthographicCamera>(file.cameras[1].camera).height == Approx(4));

  REQUIRE(file.lights.size() == 3);
  const auto& bulb = std::get<PointLight>(file.lights[0].model);
  CHECK(bulb.position == DVec3(0, 4, 0));
  CHECK(glm::distance(bulb.intensity, Vec3(1, 0.5F, 0.25F)) < 1e-6F);
  const auto& sun = std::get<DirectionalLight>(file.lights[1].model);
  CHECK(glm::distance(glm::normalize(sun.direction), DVec3(0, 0, 1)) < 1e-6);
  CHECK(sun.irradiance.x == Approx(2));
  const auto& spot = std::get<SpotLight>(file.lights[2].model);
  CHECK(spot.angle == Approx(30));
  CHECK(spot.blend == Approx(0.5));
  CHECK(glm::distance(glm::normalize(spot.direction), DVec3(0, 0, -1)) < 1e-6);
}

TEST_CASE("glTF textures load") {
  const Files files;
  files.write("images/a b.png", "never opened");
  Json json = square();
  json["images"] = Json::parse(R"([{"uri": "images/a%20b.png"}])");
  json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33071}])");
  json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 0}])");
  Json& material = json["materials"][0];
  material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
  material["normalTexture"] = {{"index", 1}, {"scale", 0.5}};
  material["alphaMode"] = "BLEND";
  material["emissiveFactor"] = {1, 2, 3};
  material["emissiveTexture"] = {{"index", 0}};
  material["doubleSided"] = true;
  const MeshFile file = read_mesh_file(files.write(json));
  const Material& paint = file.materials[file.parts[0].material];
  const auto& model = std::get<PrincipledMaterial>(paint.model);
  REQUIRE(model.base_color.texture < file.textures.size());
  const auto& base = std::get<ImageTexture>(file.textures[model.base_color.texture]);
  CHECK(base.file.filename() == "a b.png");
  CHECK(base.color_space == ColorSpace::srgb);
  CHECK(base.clamp);
  CHECK(model.metallic.channel == 2);
  CHECK(model.roughness.channel == 1);
  CHECK(model.metallic.texture == model.roughness.texture);
  const auto& rough = std::get<ImageTexture>(file.textures.at(model.roughness.texture));
  CHECK(rough.color_space == ColorSpace::linear);
  CHECK_FALSE(rough.clamp);
  CHECK(paint.normal_map == model.roughness.texture);
  CHECK(paint.normal_scale == 0.5F);
  CHECK(paint.opacity.value == 0.5F);
  CHECK(paint.opacity.channel == 3);
  CHECK(paint.opacity.texture == model.base_color.texture);
  const AreaLight& glow = file.emission[file.parts[0].material];
  CHECK(glow.radiance == Vec3(1, 2, 3));
  CHECK(glow.image == model.base_color.texture);
  CHECK(glow.two_sided);
}

TEST_CASE("glTF images inside the file load") {
  const Files files;
  Json json = square();
  json["images"] = Json::parse(R"([{"bufferView": 1, "mimeType": "image/png"},
                                   {"uri": "data:image/png;base64,aGVsbG8="}])");
  json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}])");
  Json& model = json["materials"][0]["pbrMetallicRoughness"];
  model["baseColorTexture"] = {{"index", 0}};
  model["metallicRoughnessTexture"] = {{"index", 1}};
  const MeshFile file = read_mesh_file(files.write_binary(json));
  REQUIRE(file.textures.size() == 2);
  const auto& base = std::get<ImageTexture>(file.textures[0]);
  CHECK(base.file.filename() == "square.glb, image 0");
  REQUIRE(base.bytes != nullptr);
  CHECK(*base.bytes == square_bytes().substr(128, 12));
  REQUIRE(std::get<ImageTexture>(file.textures[1]).bytes != nullptr);
  CHECK(*std::get<ImageTexture>(file.textures[1]).bytes == "hello");
}

TEST_CASE("glTF accessors may be sparse, without data or normalized") {
  const Files files;
  Json json = square();
  // All positions are 0 but for two: the second and third index, 1 and 2, become (1, 0, 0) and
  // (1, 1, 0).
  json["accessors"][0].erase("bufferView");
  json["accessors"][0]["sparse"] = Json::parse(R"({"count": 2,
      "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5123},
      "values": {"bufferView": 0, "byteOffset": 12}})");
  CHECK(area_of(read_mesh(files.write(json))) == Approx(0.5));
  json["accessors"][0]["sparse"]["count"] = 20;
  CHECK(has(files.error_of(json), "sparse part is empty or goes beyond"));
  json = square();
  json["accessors"][2]["componentType"] = 5121;
  json["accessors"][2]["normalized"] = true;
  for (const Vec2& uv : read_mesh(files.write(json)).uvs) CHECK((uv.x >= 0 && uv.x <= 1));
}

TEST_CASE("glTF vertex colors load") {
  const Files files;
  Json json = square();
  Json& color = json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"];
  color = 0;  // the positions
  const MeshFile file = read_mesh_file(files.write(json));
  const Mesh& mesh = file.meshes.at(0);
  CHECK(file.materials.at(file.parts[0].material).vertex_colors);
  CHECK(mesh.colors == mesh.positions);
  CHECK(file.warnings.empty());
  CHECK(read_mesh(files.write(json)).colors.empty());  // as are the materials

  // The bytes of 1.0F, 0.0F, 0.0F, 1.0F.
  json["accessors"].push_back(Json::parse(R"({"bufferView": 0, "byteOffset": 12, "count": 4,
      "componentType": 5121, "normalized": true, "type": "VEC4"})"));
  color = 4;
  const MeshFile bytes = read_mesh_file(files.write(json));
  CHECK(bytes.meshes.at(0).colors[0].z == Approx(128 / 255.0));
  CHECK(bytes.meshes[0].colors[1] == Vec3(0));
  REQUIRE(bytes.warnings.size() == 1);
  CHECK(bytes.warnings[0] == "left out: alpha of vertex colors");

  json["accessors"][4]["count"] = 3;
  CHECK(has(files.error_of(json), "attribute COLOR_0 has 3 values for 4 vertices"));
}

TEST_CASE("glTF files without a scene and with triangle strips or fans load") {
  const Files files;
  Json json = square();
  json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [0]}, {"mesh": 0}])");
  json.erase("scene");
  json["scenes"] = Json::parse(R"([{"nodes": [1]}, {"nodes": [2]}])");
  CHECK(read_mesh(files.write(json)).triangles.size() == 2);  // the first
  json.erase("scenes");
  CHECK(read_mesh(files.write(json)).triangles.size() == 4);  // every root
  json = square();
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["mode"] = 6;
  CHECK(area_of(read_mesh(files.write(json))) == Approx(1));
  primitive["mode"] = 5;  // 0 1 2, then 1 3 2
  CHECK(read_mesh(files.write(json)).triangles.size() == 2);
  primitive["mode"] = 1;
  CHECK(has(files.error_of(json), "no triangles"));
}

TEST_CASE("glTF emissive strength and cut-outs load, and ignored parts cause warnings") {
  const Files files;
  Json json = square();
  Json& material = json["materials"][0];
  material["emissiveFactor"] = {1, 0.5, 0};
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 5;
  material["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 1;
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.25;
  json["animations"] = Json::array({Json::object()});
  const MeshFile file = read_mesh_file(files.write(json));
  CHECK(file.emission[0].radiance == Vec3(5, 2.5F, 0));
  CHECK(file.materials[0].opacity.value == 0.5F);
  CHECK(file.materials[0].opacity_cutoff == 0.25F);
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] == "left out: KHR_materials_clearcoat, animations");
  json["extensionsRequired"] = {"KHR_materials_clearcoat"};
  CHECK(has(files.error_of(json), "it needs KHR_materials_clearcoat"));
}

TEST_CASE("glTF opens no file outside its folder") {
  const Files files;
  for (const char* uri : {"../square.bin", "/etc/passwd", "a/../../square.bin", "%2e%2e/square.bin",
                          "file:///etc/passwd"}) {
    Json json = square();
    json["buffers"][0]["uri"] = uri;
    CAPTURE(uri);
    const std::string message = files.error_of(json);
    CHECK((has(message, "outside of its folder") || has(message, "not a path relative")));
    json = square();
    json["images"] = {{{"uri", uri}}};
    json["textures"] = Json::parse(R"([{"source": 0}])");
    json["materials"][0]["normalTexture"] = {{"index", 0}};
    CHECK_FALSE(files.error_of(json).empty());
  }
}

TEST_CASE("Broken glTF files are errors") {
  const Files files;
  const auto broken = [&](const std::string& pointer, const Json& value) {
    Json json = square();
    json[Json::json_pointer(pointer)] = value;
    return files.error_of(json);
  };
  CHECK(files.error_of(square()).empty());
  CHECK(has(broken("/asset/version", "1.0"), "version 2"));
  CHECK(has(broken("/buffers/0/uri", "none.bin"), "no file 'none.bin'"));
  CHECK(has(broken("/buffers/0/byteLength", 141), "has 140 bytes of 141"));
  CHECK(has(broken("/bufferViews/0/byteLength", 141), "beyond its buffer"));
  CHECK(has(broken("/bufferViews/0/byteOffset", 13), "beyond its buffer"));
  CHECK(has(broken("/bufferViews/0/byteOffset", -1), "not a sensible number"));
  CHECK(has(broken("/bufferViews/0/buffer", 1), "'buffer' names number 1 of 1"));
  CHECK(has(broken("/accessors/0/count", 100), "beyond its buffer view"));
  CHECK(has(broken("/accessors/0/count", 0), "is empty"));
  CHECK(has(broken("/accessors/0/bufferView", 7), "'bufferView' names"));
  CHECK(has(broken("/accessors/0/componentType", 5127), "unknown component type"));
  CHECK(has(broken("/accessors/0/type", "VEC5"), "unknown type"));
  CHECK(has(broken("/accessors/0/type", "VEC2"), "POSITION is not"));
  CHECK(has(broken("/accessors/1/count", 3), "NORMAL has 3 values for 4"));
  CHECK(has(broken("/accessors/3/componentType", 5126), ""));
  CHECK(has(broken("/meshes/0/primitives/0/indices", 2), "not whole numbers"));
  CHECK(has(broken("/meshes/0/primitives/0/attributes/POSITION", 9), "'POSITION' names"));
  CHECK(has(broken("/nodes/0/children", {0}), "circle"));
  CHECK(has(broken("/nodes/0/children", {5}), "node 0 has a child that does not exist"));
  CHECK(has(broken("/accessors", 3), "not a list"));
  CHECK(has(broken("/asset", 3), "not of the kind"));
  CHECK_FALSE(broken("/nodes/0/mesh", 3).empty());
  CHECK_FALSE(broken("/scenes/0/nodes", {7}).empty());
  CHECK_FALSE(broken("/meshes/0/primitives/0/material", 3).empty());
  CHECK_FALSE(broken("/nodes/0/scale", {1e300, 1e300, 1e300}).empty());
  CHECK(has(broken("/extensionsRequired", {"KHR_draco_mesh_compression"}), "compressed"));

  std::string bytes = square_bytes();
  bytes[128] = 4;
  files.write("square.bin", bytes);
  CHECK(has(files.error_of(square()), "index 0 of a mesh names vertex 4 of 4"));
  bytes = square_bytes();
  const float infinite = INFINITY;
  bytes.replace(4, 4, reinterpret_cast<const char*>(&infinite), 4);
  files.write("square.bin", bytes);
  CHECK(has(files.error_of(square()), "position of vertex 0 is not finite"));
}

TEST_CASE("glTF skins, morphs and animations are ignored") {
  const Files files;
  Json json = square();
  json["skins"] = Json::parse(R"([{"joints": [0, 99]}])");
  json["animations"] = Json::parse(R"([{"channels": [{"sampler": 3}], "samplers": 7}])");
  json["nodes"][0]["skin"] = 0;
  json["meshes"][0]["weights"] = {1};
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 99}}};
  json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = 99;
  for (const auto& file : {files.write(json), files.write_binary(json)})
    CHECK(read_mesh(file).triangles.size() == 2);
}

TEST_CASE("glTF nodes that are circular, too deep or shared are errors") {
  const Files files;
  Json json = square();
  json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
  CHECK(has(files.error_of(json), "circle"));
  json["nodes"] = Json::parse(R"([{"children": [1, 1]}, {"mesh": 0}])");
  CHECK(has(files.error_of(json), "more than one parent"));
  json["nodes"] = Json::array();
  for (int i = 0; i < 300; ++i) json["nodes"].push_back({{"children", {i + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  CHECK(has(files.error_of(json), "256 deep"));
}

TEST_CASE("glTF files that end early are errors") {
  const Files files;
  std::ifstream stream(files.write_binary(square()), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    CAPTURE(size);
    CHECK_FALSE(Files::error_of(files.write("cut.glb", whole.substr(0, size))).empty());
  }
  CHECK(has(Files::error_of(files.write("cut.gltf", "{\n\"asset\": {\n")), "not JSON"));
  CHECK(has(Files::error_of(files.write("cut.gltf", whole)), "binary glTF"));
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += '[';
  CHECK(has(Files::error_of(files.write("deep.gltf", deep)), "not JSON"));
}

TEST_CASE("Mutated glTF files load or are errors") {
  const Files files;
  Json json = square();
  json["nodes"][0] = Json::parse(R"({"children": [1, 2], "translation": [1, 2, 3]})");
  json["nodes"].push_back(Json::parse(R"({"mesh": 0, "scale": [2, 1, 1], "camera": 0})"));
  json["nodes"].push_back(
      Json::parse(R"({"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  json["extensions"] = Json::parse(
      R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}})");
  const std::string seed = json.dump();
  std::mt19937 random(1);
  int read_well = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string bytes = mutated(seed, random, "0123456789-.e,:[]{}\"");
    CAPTURE(bytes);
    try {
      const MeshFile file = read_mesh_file(files.write("square.gltf", bytes));
      ++read_well;
      for (const Mesh& mesh : file.meshes)
        for (const UVec3& t : mesh.triangles)
          REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
    } catch (const MeshFileError&) {
      continue;
    }
  }
  CHECK(read_well > 100);
}
