#include "catch.hpp"

#include <algorithm>

#include "gltf_square.hpp"
#include "support/mesh_checks.hpp"
#include "support/mutate.hpp"

using namespace pah;
using namespace pah::test;

TEST_CASE("glTF: no file outside of the folder is opened") {
  const GltfFiles files;
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

TEST_CASE("glTF: broken files are refused with the reason") {
  const GltfFiles files;
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
  CHECK(has(broken("/bufferViews/0/byteOffset", -1), "not a valid number"));
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
  CHECK(has(broken("/nodes/0/children", {0}), "cycle"));
  CHECK(has(broken("/nodes/0/children", {5}), "node 0 has a child that does not exist"));
  CHECK(has(broken("/accessors", 3), "not a list"));
  CHECK(has(broken("/asset", 3), "has a type that glTF does not allow"));
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

TEST_CASE("glTF: skins, morphs and animations are left out") {
  const GltfFiles files;
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

TEST_CASE("glTF: nodes in a cycle, too deep or shared are refused") {
  const GltfFiles files;
  Json json = square();
  json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
  CHECK(has(files.error_of(json), "cycle"));
  json["nodes"] = Json::parse(R"([{"children": [1, 1]}, {"mesh": 0}])");
  CHECK(has(files.error_of(json), "more than one parent"));
  json["nodes"] = Json::array();
  for (int i = 0; i < 300; ++i) json["nodes"].push_back({{"children", {i + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  CHECK(has(files.error_of(json), "256 deep"));
}

TEST_CASE("glTF: files that end early are refused") {
  const GltfFiles files;
  std::ifstream stream(files.write_binary(square()), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    CAPTURE(size);
    CHECK_FALSE(GltfFiles::error_of(files.write("cut.glb", whole.substr(0, size))).empty());
  }
  CHECK(has(GltfFiles::error_of(files.write("cut.gltf", "{\n\"asset\": {\n")), "not JSON"));
  CHECK(has(GltfFiles::error_of(files.write("cut.gltf", whole)), "binary glTF"));
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += '[';
  CHECK(has(GltfFiles::error_of(files.write("deep.gltf", deep)), "not JSON"));
}

TEST_CASE("glTF: mutated files are meshes or errors") {
  const GltfFiles files;
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
