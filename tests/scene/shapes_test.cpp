#include "catch.hpp"

#include <cmath>
#include <numbers>
#include <pah/scene/shapes.hpp>

#include "support/mesh_checks.hpp"

using namespace pah;

namespace {

constexpr double pi = std::numbers::pi;

// Surface area of a regular polygon with n corners on the unit circle.
double polygon_measure(int n) { return 0.5 * n * std::sin(2 * pi / n); }

HeightFieldShape hill(int columns, int rows) {
  HeightFieldShape shape;
  shape.size = {4, 2};
  shape.height = 0.5;
  shape.columns = columns;
  shape.rows = rows;
  for (int z = 0; z < rows; ++z)
    for (int x = 0; x < columns; ++x)
      shape.heights.push_back(static_cast<float>(x) / static_cast<float>(columns - 1));
  return shape;
}

std::vector<Shape> every_shape() {
  return {RectangleShape{{2, 3}}, DiskShape{2, 7},       BoxShape{{1, 2, 3}}, SphereShape{},
          CylinderShape{},        ConeShape{0.5, 2, 32}, TorusShape{},        hill(9, 5)};
}

}  // namespace

TEST_CASE("Shapes have sound indices, unit normals on the outside and texture coordinates") {
  for (const Shape& shape : every_shape()) {
    const Mesh mesh = make_mesh(shape);
    CAPTURE(shape.index());
    REQUIRE_FALSE(mesh.triangles.empty());
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    for (const UVec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) REQUIRE(t[k] < mesh.positions.size());
      const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      const Vec3 normal = glm::cross(b - a, c - a);
      REQUIRE(glm::length(normal) > 0);
      const float side = (mesh.uvs[t.y].x - mesh.uvs[t.x].x) * (mesh.uvs[t.z].y - mesh.uvs[t.x].y) -
                         (mesh.uvs[t.z].x - mesh.uvs[t.x].x) * (mesh.uvs[t.y].y - mesh.uvs[t.x].y);
      REQUIRE(side > 0);  // pictures are not mirrored
      for (int k = 0; k < 3; ++k) {
        const Vec3 n = mesh.normals[t[k]];
        REQUIRE(std::abs(glm::length(n) - 1) < 1e-6F);
        REQUIRE(glm::dot(n, normal) > 0);
        const Vec2 uv = mesh.uvs[t[k]];
        REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
      }
    }
  }
}

TEST_CASE("Closed shapes are closed to the last bit") {
  for (const int segments : {3, 4, 5, 31, 64, 129}) {
    CAPTURE(segments);
    CHECK(is_closed(make_mesh(SphereShape{0.7, segments, 2})));
    CHECK(is_closed(make_mesh(SphereShape{0.7, segments, 33})));
    CHECK(is_closed(make_mesh(CylinderShape{0.3, 1.1, segments})));
    CHECK(is_closed(make_mesh(ConeShape{0.3, 1.1, segments})));
    CHECK(is_closed(make_mesh(TorusShape{0.9, 0.123, segments, 3})));
    CHECK(is_closed(make_mesh(TorusShape{0.9, 0.123, 7, segments})));
  }
  CHECK(is_closed(make_mesh(BoxShape{{0.1, 0.2, 0.3}})));
  CHECK_FALSE(is_closed(make_mesh(CylinderShape{0.3, 1.1, 8, false})));
  CHECK_FALSE(is_closed(make_mesh(RectangleShape{})));
}

TEST_CASE("Areas and volumes are those of the inscribed polyhedra") {
  CHECK(area_of(make_mesh(RectangleShape{{2, 3}})) == Approx(6));
  CHECK(area_of(make_mesh(DiskShape{2, 7})) == Approx(4 * polygon_measure(7)));
  CHECK(volume_of(make_mesh(BoxShape{{1, 2, 3}})) == Approx(6));
  CHECK(area_of(make_mesh(BoxShape{{1, 2, 3}})) == Approx(22));
  CHECK(volume_of(make_mesh(CylinderShape{2, 3, 9})) == Approx(12 * polygon_measure(9)));
  CHECK(volume_of(make_mesh(ConeShape{2, 3, 9})) == Approx(4 * polygon_measure(9)));
  // A torus of polygons: each slice between two rings is a prism of the tube's polygon.
  CHECK(volume_of(make_mesh(TorusShape{3, 1, 512, 9})) ==
        Approx(2 * pi * 3 * polygon_measure(9)).epsilon(1e-4));
  const double exact = 4.0 / 3 * pi;
  const double coarse = exact - volume_of(make_mesh(SphereShape{1, 64, 32}));
  const double fine = exact - volume_of(make_mesh(SphereShape{1, 128, 64}));
  CHECK(coarse > 0);
  CHECK(coarse < 0.01 * exact);
  CHECK(coarse / fine == Approx(4).epsilon(0.01));  // second order
}

TEST_CASE("A height field stands over its rectangle, first row at the far edge") {
  HeightFieldShape shape = hill(3, 2);
  shape.heights = {0, 1, 2, 3, 4, 5};
  const Mesh mesh = make_mesh(shape);
  REQUIRE(mesh.positions.size() == 6);
  CHECK(mesh.positions[0] == Vec3(-2, 1.5F, 1));
  CHECK(mesh.uvs[0] == Vec2(0, 0));
  CHECK(mesh.positions[3] == Vec3(-2, 0, -1));
  CHECK(mesh.uvs[3] == Vec2(0, 1));
  CHECK(mesh.positions[5] == Vec3(2, 1, -1));
  const Mesh plane = make_mesh(hill(9, 5));
  const Vec3 expected = glm::normalize(Vec3(-0.5F / 4, 1, 0));
  for (const Vec3& n : plane.normals) CHECK(glm::distance(n, expected) < 1e-6F);
}

TEST_CASE("Shapes refuse values out of range") {
  CHECK_THROWS_AS(make_mesh(RectangleShape{{0, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(DiskShape{NAN, 8}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(BoxShape{{1, 1, -1}}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(SphereShape{1, 2, 8}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(SphereShape{INFINITY}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(TorusShape{1, 1}), std::invalid_argument);
  HeightFieldShape field = hill(3, 3);
  field.heights[4] = NAN;
  CHECK_THROWS_AS(make_mesh(field), std::invalid_argument);
  field = hill(3, 3);
  field.heights.pop_back();
  CHECK_THROWS_AS(make_mesh(field), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(hill(1, 3)), std::invalid_argument);
}
