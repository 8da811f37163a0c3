// Boxes as glTF: read back by hand, and by the checks that mesh files go through.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pah/load/mesh_file.hpp>
#include <set>

#include "catch.hpp"
#include "hand_made_tree.hpp"
#include "load/mesh/gltf/document.hpp"
#include "read_gltf.hpp"
#include "report/inspect/pictures/box_gltf.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using nlohmann::json;

TEST_CASE("Boxes are twelve edges each, a mesh for every level") {
  const json gltf = json::parse(boxes_gltf(test::hand_made_tree(), 2, DVec3{1e6, 2, 3}));
  CHECK(gltf["asset"]["version"] == "2.0");
  REQUIRE(gltf["meshes"].size() == 2);
  CHECK(gltf["nodes"][0]["translation"] == json({1e6, 2.0, 3.0}));
  CHECK(gltf["nodes"][0]["children"] == json({1, 2}));
  CHECK(gltf["materials"][0] != gltf["materials"][1]);

  for (std::size_t level = 0; level < 2; ++level) {
    const auto [positions, ends] = test::lines_of_mesh(gltf, level);
    const std::size_t boxes = level + 1;
    REQUIRE(positions.size() == 8 * boxes);
    REQUIRE(ends.size() == 12 * boxes);
    const json& accessor = gltf["accessors"][2 * level + 1];
    CHECK(accessor["min"] == json({0.0, 0.0, 0.0}));
    CHECK(accessor["max"] == json({4.0, 2.0, 2.0}));

    // An edge runs along one axis, within one box, and is there once.
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [a, b] : ends) {
      CHECK(a / 8 == b / 8);
      int differing = 0;
      for (int axis = 0; axis < 3; ++axis)
        differing += positions[a][axis] != positions[b][axis] ? 1 : 0;
      CHECK(differing == 1);
      edges.emplace(std::min(a, b), std::max(a, b));
    }
    CHECK(edges.size() == 12 * boxes);
  }
  // The boxes of level 1 are those of nodes 1 and 2.
  const std::vector<Vec3> positions = test::lines_of_mesh(gltf, 1).positions;
  CHECK(positions[0].x == 0);
  CHECK(positions[7].x == 2.5F);
  CHECK(positions[8].x == 1.5F);
  CHECK(positions[15].x == 4);
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
