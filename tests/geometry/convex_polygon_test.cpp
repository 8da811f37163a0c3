#include <cmath>
#include <limits>
#include <pah/geometry/convex_polygon.hpp>
#include <random>

#include "catch.hpp"

using namespace pah;

namespace {

double cross(const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; }

const ConvexPolygon square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

ConvexPolygon moved(ConvexPolygon p, const DVec2& by) {
  for (DVec2& v : p) v += by;
  return p;
}

}  // namespace

TEST_CASE("Orientation is exact where rounded arithmetic cannot decide") {
  // Points within some ulps of a line through the origin: sums of integers are exact.
  std::mt19937 random(1);
  std::uniform_int_distribution<int> ulps(-8, 8);
  int naive_wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = std::numeric_limits<double>::epsilon();
    const int ax = ulps(random), ay = ulps(random);
    const DVec2 a(0.5 + ax * u, 0.5 + ay * u), b(12, 12), c(24, 24);
    // The line is x = y: the sign of ay - ax gives the side.
    const int expected = (ax > ay) - (ax < ay);  // right of b -> c is below the line
    REQUIRE(orientation(b, c, a) == -expected);
    const double naive = cross(b - a, c - a);
    naive_wrong += ((naive > 0) - (naive < 0)) != -expected;
  }
  CHECK(naive_wrong > 0);
}

TEST_CASE("A hull has neither duplicate nor collinear points") {
  const std::vector<DVec2> points{{0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2},
                                  {1, 1}, {2, 2}, {0, 0}, {0, 1}, {2, 1}};
  CHECK(convex_hull(points) == ConvexPolygon{{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  CHECK(convex_hull(std::vector<DVec2>{{1, 1}, {1, 1}}) == ConvexPolygon{{1, 1}});
  CHECK(convex_hull(std::vector<DVec2>{{0, 0}, {1, 1}, {2, 2}}).size() == 2);
  CHECK(convex_hull({}).empty());
}

TEST_CASE("A polygon contains its boundary, even with repeated vertices") {
  const ConvexPolygon repeated{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {0, 0}};
  for (const DVec2& p : {DVec2(0, 0), DVec2(0.5, 0), DVec2(1, 0.25), DVec2(1, 1)}) {
    CHECK(contains(square, p));
    CHECK(contains(repeated, p));
  }
  CHECK(contains(repeated, DVec2(0.5)));
  CHECK_FALSE(contains(square, DVec2(1, std::nextafter(1.0, 2.0))));
  CHECK_FALSE(contains(square, DVec2(-5e-324, 0.5)));
  const ConvexPolygon segment{{0, 0}, {2, 2}};
  CHECK(contains(segment, DVec2(1, 1)));
  CHECK_FALSE(contains(segment, DVec2(3, 3)));
  CHECK_FALSE(contains(segment, DVec2(1, 1.5)));
  CHECK_FALSE(contains({}, DVec2(0)));
}

TEST_CASE("Identical, collinear, touching and contained polygons overlap correctly") {
  CHECK(overlap_area(square, square) == 1);

  const ConvexPolygon shifted = moved(square, {0.5, 0});
  CHECK(overlap_area(square, shifted) == 0.5);
  CHECK(overlap_area(square, moved(square, {1, 0})) == 0);     // an edge in common
  CHECK(overlap_area(square, moved(square, {1, 1})) == 0);     // a corner
  CHECK(overlap_area(square, moved(square, {1, -0.5})) == 0);  // part of an edge
  CHECK(overlap_area(square, moved(square, {3, 0})) == 0);
  CHECK(overlap_area(square, {{0.25, 0.25}, {0.5, 0.25}, {0.25, 0.5}}) == Approx(1.0 / 32));
  CHECK(overlap_area(square, {{0, 0}, {1, 0}, {0, 1}}) == 0.5);  // shares two edges
  CHECK(overlap_area(square, {{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}}) == 1);
  CHECK(overlap_area(square, {{0, 0}, {0.5, 0.5}, {1, 1}}) == 0);
  CHECK(overlap_area(square, {{0, 0}, {1, 1}}) == 0);
  CHECK(overlap_area(square, {}) == 0);
  const ConvexPolygon far = moved(square, {1e9, -1e9});
  CHECK(overlap_area(far, far) == 1);
}

TEST_CASE("The shoelace formula stays accurate far from the origin") {
  CHECK(area(square) == 1);
  const ConvexPolygon small = moved({{0, 0}, {1e-3, 0}, {0, 1e-3}}, {1e7, 1e7});
  double naive = 0;
  for (std::size_t i = 0; i < 3; ++i) naive += cross(small[i], small[(i + 1) % 3]);
  CHECK(std::abs(naive / 2 / 0.5e-6 - 1) > 0.01);
  CHECK(area(small) == Approx(0.5e-6).epsilon(1e-5));  // the corners themselves are rounded
  CHECK(area(ConvexPolygon{{0, 0}, {1, 1}}) == 0);
}
