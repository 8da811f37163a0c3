// Influence areas and the octree over them as glTF.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "read_gltf.hpp"
#include "report/inspect/pictures/area_gltf.hpp"

using namespace pah;
using nlohmann::json;

namespace {

constexpr double pi = std::numbers::pi;
const DVec3 eye{1, 3, -2}, forward{0, -1, 0}, start{-4, 5, 0}, along{0.6, -0.8, 0};

SceneArea point_area(double near) {
  const DVec2 fov{pi / 2, pi / 3};  // tangents of halves: 1 and 1 / sqrt(3)
  return {"a \"bulb\"", "bulb", 0, make_point_area(eye, forward, fov, near, 4), true};
}
SceneArea plane_area() {
  return {"sun", "sun", 1, make_plane_area(start, along, {2, 1}, 3), false};
}

json gltf_of(const std::vector<SceneArea>& areas, std::uint32_t levels = 8) {
  TopLevelConfig top_level;
  top_level.octree_depth = 4;
  return json::parse(areas_gltf(areas, area_octree(areas, top_level), levels, DVec3{1, 2, 3}));
}

std::vector<double> edge_lengths(const test::GltfLines& lines) {
  std::vector<double> lengths;
  for (const auto& [a, b] : lines.edges)
    lengths.push_back(glm::distance(lines.positions[a], lines.positions[b]));
  std::ranges::sort(lengths);
  return lengths;
}

bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) < 1e-5; });
}

// How many positions are so far along a direction, and so far from its axis.
std::ptrdiff_t count_at(const test::GltfLines& lines, const DVec3& from, const DVec3& direction,
                        double depth, double radius) {
  return std::ranges::count_if(lines.positions, [&](const Vec3& position) {
    const DVec3 way = DVec3(position) - from;
    const double z = glm::dot(way, direction);
    return std::abs(z - depth) < 1e-5 && std::abs(glm::length(way - z * direction) - radius) < 1e-5;
  });
}

Aabb box_of(const std::vector<Vec3>& positions, std::size_t first, std::size_t count) {
  Aabb box;
  for (std::size_t i = first; i < first + count; ++i) box.extend(positions[i]);
  return box;
}

bool is_within(const Aabb& inner, const Aabb& outer) {
  return contains(outer, inner.min) && contains(outer, inner.max);
}

}  // namespace

TEST_CASE("A point area is drawn as its frustum") {
  const json gltf = gltf_of({point_area(1)});
  CHECK(gltf["nodes"][0]["translation"] == json({1.0, 2.0, 3.0}));
  CHECK(gltf["nodes"][1]["name"] == "a \"bulb\"");
  const test::GltfLines lines = test::lines_of_mesh(gltf, 0);
  REQUIRE(lines.positions.size() == 8);
  const double diagonal = std::sqrt(1 + 1.0 / 3);
  CHECK(count_at(lines, eye, forward, 1, diagonal) == 4);
  CHECK(count_at(lines, eye, forward, 4, 4 * diagonal) == 4);
  const double height = 2 / std::sqrt(3.0), side = 3 * std::sqrt(1 + diagonal * diagonal);
  CHECK(are_equal(edge_lengths(lines),
                  {height, height, 2, 2, side, side, side, side, 4 * height, 4 * height, 8, 8}));
}

TEST_CASE("A point area that begins at its eye is drawn as a pyramid") {
  const test::GltfLines lines = test::lines_of_mesh(gltf_of({point_area(0)}), 0);
  CHECK(count_at(lines, eye, forward, 0, 0) == 4);
  CHECK(lines.edges.size() == 8);
}

TEST_CASE("A plane area is drawn as its box") {
  const test::GltfLines lines = test::lines_of_mesh(gltf_of({plane_area()}), 0);
  REQUIRE(lines.positions.size() == 8);
  const double diagonal = std::sqrt(1.25);
  CHECK(count_at(lines, start, along, 0, diagonal) == 4);
  CHECK(count_at(lines, start, along, 3, diagonal) == 4);
  CHECK(are_equal(edge_lengths(lines), {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}));
}

TEST_CASE("The octree's cells are halved level by level, and hold their areas") {
  const json gltf = gltf_of({point_area(1), plane_area()});
  // The root's children are the areas and the octree, whose children are its levels.
  REQUIRE(gltf["nodes"][0]["children"] == json({1, 2, 3}));
  const json& octree = gltf["nodes"][3];
  CHECK(octree["name"] == "octree");
  REQUIRE(octree["children"] == json({4, 5, 6, 7, 8}));
  REQUIRE(gltf["meshes"].size() == 7);
  CHECK(gltf["accessors"].size() == 14);
  CHECK(gltf["materials"][0] != gltf["materials"][1]);

  std::vector<Aabb> above;
  for (std::size_t level = 0; level < 5; ++level) {
    CHECK(gltf["nodes"][4 + level]["name"] == "level " + std::to_string(level));
    const test::GltfLines lines = test::lines_of_mesh(gltf, 2 + level);
    const std::size_t count = lines.positions.size() / 8;
    REQUIRE(lines.edges.size() == 12 * count);
    REQUIRE((level == 0 ? count == 1 : count >= 8));
    std::vector<Aabb> cells;
    for (std::size_t i = 0; i < count; ++i) {
      const Aabb& cell = cells.emplace_back(box_of(lines.positions, 8 * i, 8));
      if (level == 0) continue;
      // Eight cells make up one of the level above.
      const Aabb whole = box_of(lines.positions, i / 8 * 64, 64);
      CHECK(std::ranges::count(above, whole) == 1);
      CHECK(is_within(cell, whole));
      CHECK(glm::distance(2.0F * cell.extent(), whole.extent()) < 1e-5F);
    }
    above = std::move(cells);
    if (level > 0) continue;
    for (std::size_t area = 0; area < 2; ++area)
      CHECK(is_within(box_of(test::lines_of_mesh(gltf, area).positions, 0, 8), above[0]));
  }
  CHECK(gltf_of({point_area(1), plane_area()}, 2)["meshes"].size() == 4);
}

TEST_CASE("Without areas there is an empty root") {
  const json gltf = gltf_of({});
  CHECK(gltf["nodes"].size() == 1);
  CHECK_FALSE(gltf["nodes"][0].contains("children"));
  CHECK_FALSE(gltf.contains("meshes"));
  CHECK_FALSE(gltf.contains("buffers"));
}
