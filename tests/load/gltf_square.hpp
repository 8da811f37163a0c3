// A square as a glTF file, for tests to change.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <pah/load/mesh_file.hpp>

#include "support/temporary_folder.hpp"

namespace pah::test {

using Json = nlohmann::json;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns positions, normals and texture coordinates of a square in the xy plane, then indices.
inline std::string square_bytes() {
  std::string bytes;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
    append(bytes, p);
  for (int i = 0; i < 4; ++i) append(bytes, Vec3(0, 0, 1));
  for (const Vec2& uv : {Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 0}}) append(bytes, uv);
  for (const std::uint16_t i : {0, 1, 2, 0, 2, 3}) append(bytes, i);
  return bytes;
}

inline Json square() {
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

class GltfFiles {
 public:
  GltfFiles() { write("square.bin", square_bytes()); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  [[nodiscard]] std::filesystem::path write(const Json& json) const {
    return write("square.gltf", json.dump(1));
  }
  // Writes binary glTF with the buffer inside.
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

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace pah::test
