// Lines of a glTF file, read back by hand.
#pragma once

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <pah/geometry/vec.hpp>
#include <string>
#include <vector>

#include "catch.hpp"

namespace pah::test {

inline std::string decoded_base64(const std::string& base64) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>(bits >> held & 0xFFU));
  }
  return bytes;
}

template <typename Value>
std::vector<Value> accessor_values(const nlohmann::json& gltf, std::size_t accessor) {
  const std::string uri = gltf["buffers"][0]["uri"];
  const std::string bytes = decoded_base64(uri.substr(uri.find(',') + 1));
  REQUIRE(bytes.size() == gltf["buffers"][0]["byteLength"].get<std::size_t>());
  const nlohmann::json& a = gltf["accessors"][accessor];
  const nlohmann::json& view = gltf["bufferViews"][a["bufferView"].get<std::size_t>()];
  const std::size_t components = a["type"] == "VEC3" ? 3 : 1;
  std::vector<Value> out(a["count"].get<std::size_t>() * components * 4 / sizeof(Value));
  REQUIRE(out.size() * sizeof(Value) == view["byteLength"].get<std::size_t>());
  const std::size_t offset = view.value("byteOffset", std::size_t{0});
  REQUIRE(offset + out.size() * sizeof(Value) <= bytes.size());
  std::memcpy(out.data(), bytes.data() + offset, out.size() * sizeof(Value));
  return out;
}

struct GltfLines {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

// Of a mesh that is one set of lines. Its accessor's bounds are those of its positions.
inline GltfLines lines_of_mesh(const nlohmann::json& gltf, std::size_t mesh) {
  REQUIRE(gltf["meshes"][mesh]["primitives"].size() == 1);
  const nlohmann::json& primitive = gltf["meshes"][mesh]["primitives"][0];
  CHECK(primitive["mode"] == 1);
  const auto at = primitive["attributes"]["POSITION"].get<std::size_t>();
  GltfLines lines{accessor_values<Vec3>(gltf, at),
                  accessor_values<std::array<std::uint32_t, 2>>(gltf, primitive["indices"])};
  Vec3 low = lines.positions.at(0), high = low;
  for (const Vec3& position : lines.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  CHECK(gltf["accessors"][at]["min"] == nlohmann::json({low.x, low.y, low.z}));
  CHECK(gltf["accessors"][at]["max"] == nlohmann::json({high.x, high.y, high.z}));
  for (const auto& [a, b] : lines.edges) REQUIRE(std::max(a, b) < lines.positions.size());
  return lines;
}

}  // namespace pah::test
