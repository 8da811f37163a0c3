#include "catch.hpp"

#include <algorithm>
#include <cmath>

#include "gltf_square.hpp"
#include "support/mesh_checks.hpp"

using namespace pah;
using namespace pah::test;

TEST_CASE("glTF: a square is read from text and from bytes") {
  const GltfFiles files;
  for (const auto& file : {files.write(square()), files.write_binary(square())}) {
    CAPTURE(file);
    const Mesh mesh = read_mesh(file);
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.positions.size() == 4);
    CHECK(area_of(mesh) == Approx(1));
    for (const Vec3& n : mesh.normals) CHECK(n == Vec3(0, 0, 1));
    // glTF's v points down, pahrender's up.
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

TEST_CASE("glTF: nodes transform and repeat") {
  const GltfFiles files;
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
    // The winding of the mirrored square is flipped, so that it still faces +z.
    CHECK(glm::cross(mesh.positions[k.y] - a, mesh.positions[k.z] - a).z > 0);
  }
  const MeshFile whole = read_mesh_file(file);
  CHECK(whole.meshes.size() == 1);
  REQUIRE(whole.parts.size() == 2);
  CHECK(whole.parts[1].world_from_object[3] == DVec3(10, 0, 5));
}

TEST_CASE("glTF: cameras and lights are read") {
  const GltfFiles files;
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
  // After half a turn about y, the camera points along +z instead of -z.
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

TEST_CASE("glTF: textures are read") {
  const GltfFiles files;
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

TEST_CASE("glTF: embedded images are read") {
  const GltfFiles files;
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

TEST_CASE("glTF: accessors may be sparse, without data or normalized") {
  const GltfFiles files;
  Json json = square();
  // All positions are 0 except those of indices 1 and 2, which become (1, 0, 0) and (1, 1, 0).
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

TEST_CASE("glTF: vertex colors are read") {
  const GltfFiles files;
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

TEST_CASE("glTF: files without a scene show everything, in every primitive mode") {
  const GltfFiles files;
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

TEST_CASE("glTF: strength of emission and cut-outs are read, and the rest is named") {
  const GltfFiles files;
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
