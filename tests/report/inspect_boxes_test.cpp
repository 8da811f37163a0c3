// Boxes as glTF: read back by hand, and by the checks that mesh files go through.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pah/io/mesh_file.hpp>
#include <set>

#include "catch.hpp"
#include "hand_made_tree.hpp"
#include "io/mesh/gltf_document.hpp"
#include "report/box_gltf.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using nlohmann::json;

namespace {

std::string decoded(const std::string& base64) {
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
std::vector<Value> values(const json& gltf, const std::string& bytes, std::size_t accessor,
                          std::size_t components) {
  const json& a = gltf["accessors"][accessor];
  const json& view = gltf["bufferViews"][a["bufferView"].get<std::size_t>()];
  std::vector<Value> out(components * a["count"].get<std::size_t>());
  REQUIRE(out.size() * sizeof(Value) <= view["byteLength"].get<std::size_t>());
  const std::size_t offset = view.value("byteOffset", std::size_t{0});
  REQUIRE(offset + out.size() * sizeof(Value) <= bytes.size());
  std::memcpy(out.data(), bytes.data() + offset, out.size() * sizeof(Value));
  return out;
}

}  // namespace

TEST_CASE("Boxes are twelve edges each, a mesh for every level") {
  const json gltf = json::parse(boxes_gltf(test::hand_made_tree(), 2, DVec3{1e6, 2, 3}));
  CHECK(gltf["asset"]["version"] == "2.0");
  REQUIRE(gltf["meshes"].size() == 2);
  CHECK(gltf["nodes"][0]["translation"] == json({1e6, 2.0, 3.0}));
  CHECK(gltf["nodes"][0]["children"] == json({1, 2}));
  CHECK(gltf["materials"][0] != gltf["materials"][1]);

  const std::string uri = gltf["buffers"][0]["uri"];
  const std::string bytes = decoded(uri.substr(uri.find(',') + 1));
  REQUIRE(bytes.size() == gltf["buffers"][0]["byteLength"].get<std::size_t>());
  for (std::size_t level = 0; level < 2; ++level) {
    const json& primitive = gltf["meshes"][level]["primitives"][0];
    CHECK(primitive["mode"] == 1);
    const auto at = primitive["attributes"]["POSITION"].get<std::size_t>();
    const std::size_t boxes = level + 1;
    CHECK(gltf["accessors"][at]["min"] == json({0.0, 0.0, 0.0}));
    CHECK(gltf["accessors"][at]["max"] == json({4.0, 2.0, 2.0}));
    const auto positions = values<float>(gltf, bytes, at, 3);
    const auto ends =
        values<std::uint32_t>(gltf, bytes, primitive["indices"].get<std::size_t>(), 1);
    REQUIRE(positions.size() == 3 * 8 * boxes);
    REQUIRE(ends.size() == 24 * boxes);

    // An edge runs along one axis, within one box, and is there once.
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      const std::uint32_t a = ends[i], b = ends[i + 1];
      REQUIRE(std::max(a, b) < 8 * boxes);
      CHECK(a / 8 == b / 8);
      int differing = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        differing += positions[3 * a + axis] != positions[3 * b + axis] ? 1 : 0;
      CHECK(differing == 1);
      edges.emplace(std::min(a, b), std::max(a, b));
    }
    CHECK(edges.size() == 12 * boxes);
  }
  // The boxes of level 1 are those of nodes 1 and 2.
  const auto positions = values<float>(gltf, bytes, 3, 3);
  CHECK(positions[0] == 0);
  CHECK(positions[3 * 7] == 2.5F);
  CHECK(positions[3 * 8] == 1.5F);
  CHECK(positions[3 * 15] == 4);
}

TEST_CASE("Files of boxes pass the checks of glTF files") {
  const TemporaryFolder folder;
  const auto nodes = [&](const BinaryTree& tree, std::uint32_t levels) {
    std::ofstream(folder / "boxes.gltf") << boxes_gltf(tree, levels, DVec3{0});
    // All its nodes are read; none is a mesh of triangles.
    CHECK_THROWS_WITH(read_mesh_file(folder / "boxes.gltf"), contains_text("no triangles"));
    return read_gltf_document(folder / "boxes.gltf", folder.path(), 1 << 20)
        .json.at("nodes")
        .size();
  };
  for (const std::uint32_t levels : {1U, 2U, 3U, 80U})
    CHECK(nodes(test::hand_made_tree(), levels) == 1 + std::min(levels, 3U));
  CHECK(nodes(BinaryTree{}, 8) == 1);
}
