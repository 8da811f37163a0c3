#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <pah/scene/placement.hpp>
#include <pah/scene/shapes.hpp>

using namespace pah;

namespace {

bool close(const DVec3& a, const DVec3& b) { return glm::distance(a, b) < 1e-12; }

}  // namespace

TEST_CASE("Lines, grids and rings stand where they should") {
  const auto line = place(LineRepeat{3, {1, 2, 3}});
  REQUIRE(line.size() == 3);
  CHECK(line[2][3] == DVec3(2, 4, 6));

  const auto grid = place(GridRepeat{{3, 1, 2}, {2, 5, 4}, true});
  REQUIRE(grid.size() == 6);
  CHECK(grid[0][3] == DVec3(-2, 0, -2));
  CHECK(grid[1][3] == DVec3(0, 0, -2));
  CHECK(grid[5][3] == DVec3(2, 0, 2));
  CHECK(place(GridRepeat{{2, 1, 1}, {2, 5, 4}, false})[1][3] == DVec3(2, 0, 0));

  const auto ring = place(RingRepeat{4, 2, 0, true});
  REQUIRE(ring.size() == 4);
  CHECK(close(ring[0][3], {2, 0, 0}));
  CHECK(close(ring[1][3], {0, 0, -2}));
  CHECK(close(ring[1][0], {0, 0, -1}));  // a copy's +x keeps pointing outwards
  CHECK(close(place(RingRepeat{4, 2, 0, false})[1][0], {1, 0, 0}));
}

TEST_CASE("Counts are known before anything is allocated") {
  CHECK(count_of(GridRepeat{{3, 4, 5}}) == 60);
  CHECK(count_of(GridRepeat{UVec3(0xFFFFFFFFU)}) == UINT64_MAX);
  CHECK_THROWS_AS(place(LineRepeat{0}), std::invalid_argument);
  CHECK_THROWS_AS(place(LineRepeat{2, {NAN, 0, 0}}), std::invalid_argument);
}

TEST_CASE("Composition applies the right transform first") {
  const glm::dmat4x3 move{DVec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}};
  const glm::dmat4x3 scale{DVec3{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 0, 0}};
  CHECK(compose(move, scale) * glm::dvec4(1, 1, 1, 1) == DVec3(3, 4, 5));
  CHECK(compose(scale, move) * glm::dvec4(1, 1, 1, 1) == DVec3(4, 6, 8));
}

TEST_CASE("Scattering depends on its seed alone") {
  ScatterOptions options;
  options.count = 100;
  options.seed = 7;
  options.scale = {0.5, 2};
  const auto a = scatter(DVec2{4, 2}, options);
  CHECK(a == scatter(DVec2{4, 2}, options));
  REQUIRE(a.size() == 100);
  // Adding copies does not move the first ones.
  options.count = 200;
  const auto b = scatter(DVec2{4, 2}, options);
  CHECK(std::equal(a.begin(), a.end(), b.begin()));
  options.seed = 8;
  CHECK(b != scatter(DVec2{4, 2}, options));
  for (const auto& m : a) {
    CHECK((std::abs(m[3].x) <= 2 && m[3].y == 0 && std::abs(m[3].z) <= 1));
    const double s = std::cbrt(glm::determinant(DMat3(m)));
    CHECK((s >= 0.5 && s <= 2));
    CHECK(close(glm::normalize(m[1]), {0, 1, 0}));
  }
}

TEST_CASE("Scattered copies do not move between versions or platforms") {
  ScatterOptions options;
  options.count = 3;
  options.seed = 1;
  options.turn = false;
  const auto copies = scatter(DVec2{1, 1}, options);
  CHECK(copies[0][3].x == -0x1.3a86a1eb4c488p-4);
  CHECK(copies[2][3].z == 0x1.a4c2be4ebc36ap-2);
}

TEST_CASE("Rectangles are covered evenly, whether by name or as two triangles") {
  ScatterOptions options;
  options.count = 16000;
  const Mesh mesh = make_mesh(RectangleShape{{4, 4}});
  for (const auto& copies :
       {scatter(DVec2{4, 4}, options), scatter(mesh, glm::dmat4x3{1.0}, options)}) {
    int counts[16] = {};
    for (const auto& m : copies)
      ++counts[4 * static_cast<int>(m[3].x + 2) + static_cast<int>(m[3].z + 2)];
    double chi_square = 0;
    for (const int n : counts) chi_square += (n - 1000) * (n - 1000) / 1000.0;
    CHECK(chi_square < 37.7);  // 15 degrees of freedom, p = 0.001
  }
}

TEST_CASE("A mesh is covered by area and copies follow its normals") {
  // A box of 1 x 1 x 2: its faces along z hold 1 of 10 parts each.
  const Mesh box = make_mesh(BoxShape{{1, 1, 2}});
  ScatterOptions options;
  options.count = 10000;
  options.align = true;
  glm::dmat4x3 mirror{1.0};
  mirror[0].x = -1;
  for (const glm::dmat4x3& transform : {glm::dmat4x3{1.0}, mirror}) {
    int ends = 0;
    for (const auto& m : scatter(box, transform, options)) {
      const DVec3 p = m[3];
      if (std::abs(std::abs(p.z) - 1) < 1e-12) ++ends;
      CHECK(glm::length(m[1]) == Approx(1));
      CHECK(glm::dot(glm::cross(m[0], m[1]), m[2]) == Approx(1));
      CHECK(glm::dot(m[1], p) > 0);
      CHECK(glm::dot(m[1], p) < 1.01);
      const double reach =
          std::max(std::abs(p.x) / 0.5, std::max(std::abs(p.y) / 0.5, std::abs(p.z)));
      CHECK(reach == Approx(1));
    }
    CHECK(std::abs(ends - 2000) < 4 * std::sqrt(10000 * 0.2 * 0.8));
  }
}

TEST_CASE("A minimum distance is kept") {
  ScatterOptions options;
  options.count = 1000;
  options.min_distance = 0.5;
  const auto copies = scatter(DVec2{4, 4}, options);
  CHECK(copies.size() > 30);
  CHECK(copies.size() < 200);
  for (std::size_t i = 0; i < copies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) REQUIRE(glm::distance(copies[i][3], copies[j][3]) >= 0.5);
  options.min_distance = 1e-300;
  CHECK(scatter(DVec2{4, 4}, options).size() == 1000);
  options.scale = {0, 1};
  CHECK_THROWS_AS(scatter(DVec2{4, 4}, options), std::invalid_argument);
}
