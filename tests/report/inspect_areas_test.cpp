// Tests influence areas drawn as lines.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "report/inspect/pictures/area_lines.hpp"

using namespace pah;

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

std::vector<double> edge_lengths(const LineSet& lines) {
  std::vector<double> lengths;
  for (const auto& [a, b] : lines.edges)
    lengths.push_back(glm::distance(lines.positions[a], lines.positions[b]));
  std::ranges::sort(lengths);
  return lengths;
}

bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) < 1e-5; });
}

// Counts the positions at a given distance along a direction and from its axis.
std::ptrdiff_t count_at(const LineSet& lines, const DVec3& from, const DVec3& direction,
                        double depth, double radius) {
  return std::ranges::count_if(lines.positions, [&](const Vec3& position) {
    const DVec3 way = DVec3(position) - from;
    const double z = glm::dot(way, direction);
    return std::abs(z - depth) < 1e-5 && std::abs(glm::length(way - z * direction) - radius) < 1e-5;
  });
}

}  // namespace

TEST_CASE("A point area is drawn as its frustum") {
  const LineSet lines = area_lines({point_area(1)}).at(0);
  CHECK(lines.name == "a \"bulb\"");
  REQUIRE(lines.positions.size() == 8);
  const double diagonal = std::sqrt(1 + 1.0 / 3);
  CHECK(count_at(lines, eye, forward, 1, diagonal) == 4);
  CHECK(count_at(lines, eye, forward, 4, 4 * diagonal) == 4);
  const double height = 2 / std::sqrt(3.0), side = 3 * std::sqrt(1 + diagonal * diagonal);
  CHECK(are_equal(edge_lengths(lines),
                  {height, height, 2, 2, side, side, side, side, 4 * height, 4 * height, 8, 8}));
}

TEST_CASE("A point area that begins at its eye is drawn as a pyramid") {
  const LineSet lines = area_lines({point_area(0)}).at(0);
  CHECK(count_at(lines, eye, forward, 0, 0) == 4);
  CHECK(lines.edges.size() == 8);
}

TEST_CASE("A plane area is drawn as its box") {
  const LineSet lines = area_lines({plane_area()}).at(0);
  REQUIRE(lines.positions.size() == 8);
  const double diagonal = std::sqrt(1.25);
  CHECK(count_at(lines, start, along, 0, diagonal) == 4);
  CHECK(count_at(lines, start, along, 3, diagonal) == 4);
  CHECK(are_equal(edge_lengths(lines), {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}));
}
