// Tests of formulas of the thesis's section 5.4, the projection of a box, that are wrong or
// incomplete as printed. Each printed formula stands beside the correct one, so that nobody
// "corrects" the code back. CONTRIBUTING.md lists all such tests.
#include <pah/influence/box_sectors.hpp>
#include <pah/influence/influence_area.hpp>

#include "catch.hpp"
#include "exact.hpp"

using namespace pah;

namespace {

// Algorithm 5.3.
unsigned printed_index(const DVec3& direction) {
  unsigned i = 0;
  if (direction.x > 0) i |= 1U;
  if (direction.x < 0) i |= 2U;
  if (direction.y > 0) i |= 4U;
  if (direction.y < 0) i |= 8U;
  if (direction.z > 0) i |= 32U;
  if (direction.z < 0) i |= 16U;
  return i;
}

// Algorithm 5.4.
unsigned printed_index(const DVec3& eye, const Aabb& box) {
  unsigned i = 0;
  if (eye.x < box.min.x) i |= 1U;
  if (eye.x > box.max.x) i |= 2U;
  if (eye.y < box.min.y) i |= 4U;
  if (eye.y > box.max.y) i |= 8U;
  if (eye.z < box.min.z) i |= 32U;
  if (eye.z > box.max.z) i |= 16U;
  return i;
}

// The sides that an index stands for. Bits 5 to 0 are back, front, top, bottom and the two sides of
// x, whose order the thesis leaves open.
BoxSector sector_of_bits(unsigned index, bool bit_0_is_left) {
  const auto bit = [&](unsigned k) { return static_cast<int>(index >> k & 1U); };
  const int x = bit(1) - bit(0);
  return {bit_0_is_left ? x : -x, bit(3) - bit(2), bit(4) - bit(5)};
}

// Only the order of corners is taken from these regions; their bounds do not matter. The axes of
// parallel rays are integers, not of unit length, so that collinear corners stay collinear.
PointArea towards_center(const DVec3& eye) {
  return make_point_area(eye, -eye, DVec2(3), 0, 100, PointMeasure::plane);
}
PlaneArea along(const DVec3& direction) {
  const DVec3 beside = direction.x == 0 ? DVec3(1, 0, 0) : DVec3(-direction.y, direction.x, 0);
  return {Obb{DVec3(0), DMat3(beside, glm::cross(direction, beside), direction), DVec3(40)}};
}

// Section 5.4.2: the corners of the hull table, divided by w, and A.10 corrected.
double printed_projected_area(const PointArea& area, const Aabb& box) {
  ConvexPolygon hull;
  for (const std::uint8_t i : outline_from(sector_of_eye(area.frustum.eye, box)).span()) {
    const DVec3 p = glm::transpose(area.frustum.axes) * (DVec3(box.corner(i)) - area.frustum.eye);
    hull.emplace_back(p.x / p.z, p.y / p.z);
  }
  return pah::area(hull);
}

// From (0, 5, 0) downwards, 45 degrees to every side: the cross-section is 4 tangents^2.
PointArea downwards(double near, PointMeasure measure = PointMeasure::plane) {
  return make_point_area({0, 5, 0}, {0, -1, 0}, DVec2(std::acos(0.0)), near, 10, measure);
}

void check_areas(const PointArea& area, const Aabb& box, double printed, double truth) {
  CAPTURE(box.min.y, box.max.y);
  CHECK(printed_projected_area(area, box) == Approx(printed).margin(1e-12));
  CHECK(projected_area(area, box) == Approx(truth).margin(1e-12));
  CHECK(exact_answer::projected_area(area, box) == Approx(truth).margin(1e-12));
}

}  // namespace

// Algorithms 5.3 and 5.4 and the table of bits before them.
TEST_CASE("A hull table whose bits name left for right gives no hull of a box") {
  const Aabb box{{-1, -2, -3}, {1, 2, 3}};
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const BoxSector sector{x, y, z};
        if (sector.inside()) continue;
        CAPTURE(x, y, z);
        const DVec3 eye(9 * x + 0.5, 9 * y + 0.25, 9 * z - 0.5);
        const DVec3 direction(-x, -y, -z);
        const PointArea point = towards_center(eye);
        const PlaneArea plane = along(direction);
        CHECK(exact_answer::is_projected_hull(point, box,
                                              outline_from(sector_of_eye(eye, box)).span()));
        CHECK(exact_answer::is_projected_hull(plane, box,
                                              outline_from(sector_of_direction(direction)).span()));
        // With one order the algorithms give our sides. With the other they do so only where the
        // box is seen neither from the left nor from the right.
        CHECK(sector_of_bits(printed_index(eye, box), true) == sector);
        CHECK(sector_of_bits(printed_index(direction), true) == sector);
        const auto misread = [&](unsigned index) {
          return outline_from(sector_of_bits(index, false)).span();
        };
        CHECK(exact_answer::is_projected_hull(point, box, misread(printed_index(eye, box))) ==
              (x == 0));
        CHECK(exact_answer::is_projected_hull(plane, box, misread(printed_index(direction))) ==
              (x == 0));
      }
}

// Equation 5.2.
TEST_CASE("What is off center keeps its place, which the printed orthographic matrix shifts") {
  const double left = 2, right = 6, bottom = -1, top = 1, far = 10;
  const auto printed_orthographic = [&](const DVec3& p) {
    return DVec3(2 / (right - left) * p.x + (left + right) / 2,
                 2 / (top - bottom) * p.y + (top + bottom) / 2, -2 / far * p.z - 1);
  };
  const PlaneArea area{Obb{{4, 0, 5}, DMat3(1.0), {2, 1, 5}}};
  for (const double x : {left, 4.0, right}) {
    const double truth = (x - 4) / 2;  // from -1 at the left to 1 at the right
    CHECK(project(area, {x, top, 0})->x / 2 == truth);
    CHECK(printed_orthographic({x, top, 0}).x == truth + 6);
  }
}

// Section 5.4.2 treats none of these cases.
TEST_CASE("A box around the eye is hit by all rays, though the printed outline is empty") {
  const Aabb box{{-1, 4, -1}, {1, 6, 1}};
  CHECK(printed_index(DVec3(0, 5, 0), box) == 0);
  check_areas(downwards(0), box, 0, 4);
  CHECK(hit_probability(downwards(0), box) == 1);
}

TEST_CASE("A box behind the eye is hit by no rays, though the printed projection mirrors it") {
  // Its lower face, 1 above the eye, has tangents of -1/2 to 1/2.
  check_areas(downwards(0), Aabb{{-0.5F, 6, -0.5F}, {0.5F, 7, 0.5F}}, 1, 0);
}

TEST_CASE("A box across the plane of the eye is seen in front of it, not mirrored as printed") {
  const Aabb box{{0.5F, 3, -1}, {4, 6, 1}};
  // 2 below the eye the box's sides have tangents of 1/4 and 1/2. The side at x = 1/2 is seen up to
  // the eye's height: by all rays of x > 1/4 except those that pass it at |z| > 1, beyond tangents
  // of 2 x.
  const double truth = 2 * (0.5 * (0.5 + 1) * 0.25 + 0.5);
  CHECK(std::abs(printed_projected_area(downwards(0), box) - truth) > 0.5);
  CHECK(projected_area(downwards(0), box) == Approx(truth));
  CHECK(exact_answer::projected_area(downwards(0), box) == Approx(truth));
}

TEST_CASE(
    "What a box has before the near plane is not hit, though the printed outline includes it") {
  const Aabb across{{-0.5F, 2.5F, -0.5F}, {0.5F, 4.5F, 0.5F}};  // depths of 1/2 to 5/2
  check_areas(downwards(0), across, 4, 4);
  check_areas(downwards(2), across, 4, 0.25);  // at a depth of 2, tangents of -1/4 to 1/4
  check_areas(downwards(3), across, 4, 0);
}

// Section 5.4.2 takes area on the picture plane for the probability of a hit.
TEST_CASE("An isotropic light's rays crowd about the axis, which area on a plane ignores") {
  const Aabb middle{{-0.5F, 0, -0.5F}, {0.5F, 4, 0.5F}};  // tangents of -1/2 to 1/2
  // A rectangle of tangents a and b with a corner on the axis has the solid angle atan(a b / sqrt(1
  // + a^2 + b^2)). The cross-section is a face of a cube, a sixth of the sphere.
  const double whole = 4 * std::acos(-1.0) / 6;
  const double truth = 4 * std::atan(0.25 / std::sqrt(1.5)) / whole;
  CHECK(truth > 0.38);
  CHECK(printed_projected_area(downwards(0), middle) / 4 == Approx(0.25));
  CHECK(hit_probability(downwards(0), middle) == Approx(0.25));
  CHECK(hit_probability(downwards(0, PointMeasure::solid_angle), middle) == Approx(truth));
}
