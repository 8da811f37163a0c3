// Compares the convention of projections with GLM's matrices.
#include <glm/gtc/matrix_transform.hpp>
#include <pah/influence/box_sectors.hpp>

#include "catch.hpp"
#include "random_shapes.hpp"

using namespace pah;

namespace {

// GLM's view looks along -z with x to the right. Ours is a right-handed (right, up, forward), whose
// first axis points left as seen along forward.
DMat4 view_of(const DVec3& eye, const DMat3& axes) {
  return glm::lookAtRH(eye, eye + axes[2], axes[1]);
}
DVec2 mirrored(const glm::dvec4& p) { return DVec2(-p.x, p.y) / p.w; }

double distance(const DVec2& a, const DVec2& b) { return glm::length(a - b); }

}  // namespace

// Replaces the thesis's equations 5.2 and 5.4.
TEST_CASE("Projections agree with GLM's matrices") {
  Shapes shapes(1);
  for (int i = 0; i < 1000; ++i) {
    const PlaneArea plane{shapes.obb(1)};
    const DVec3 h = plane.box.half_size;
    const DVec3 eye = plane.box.center - h.z * plane.box.axes[2];
    const DMat4 ortho =
        glm::orthoRH_ZO(-h.x, h.x, -h.y, h.y, 0.0, 2 * h.z) * view_of(eye, plane.box.axes);
    const DVec3 p = plane.box.center + shapes.vector();
    REQUIRE(distance(mirrored(ortho * glm::dvec4(p, 1)), *project(plane, p) / DVec2(h)) < 1e-12);

    PointArea point{shapes.frustum(1)};
    const Frustum& f = point.frustum;
    const DMat4 perspective = glm::perspectiveRH_ZO(2 * std::atan(f.tan_half.y),
                                                    f.tan_half.x / f.tan_half.y, 0.01, f.far) *
                              view_of(f.eye, f.axes);
    const DVec3 q = f.eye + f.axes * DVec3(shapes.uniform(), shapes.uniform(), 0.5);
    const DVec2 seen = *project(point, q) / f.tan_half;
    REQUIRE(distance(mirrored(perspective * glm::dvec4(q, 1)), seen) <
            1e-12 * (1 + glm::length(seen)));
    REQUIRE_FALSE(project(point, f.eye - 0.1 * f.axes[2]).has_value());
    REQUIRE_FALSE(project(point, f.eye).has_value());
  }
}

TEST_CASE("Every sector has an outline of four or six corners") {
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const BoxSector sector{x, y, z};
        const int faces = std::abs(x) + std::abs(y) + std::abs(z);
        CHECK(outline_from(sector).size == (faces == 0 ? 0 : faces == 1 ? 4 : 6));
      }
  // Eyes inside, on a face, and far away.
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  CHECK(sector_of_eye({0.5, 0.5, 0.5}, box).inside());
  CHECK(sector_of_eye({1, 0.5, 0.5}, box).inside());
  CHECK(sector_of_direction({0, -1, 0}) == BoxSector{0, 1, 0});
}
