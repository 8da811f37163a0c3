#include <cmath>
#include <limits>
#include <optional>
#include <pah/geometry/convex_polygon.hpp>
#include <random>

#include "catch.hpp"

using namespace pah;

namespace {

double cross(const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; }

// Appendix A.8, algorithm A.4 as printed (with the index wrapped, or it reads out of bounds).
bool printed_inside(const ConvexPolygon& hull, const DVec2& p) {
  const std::size_t n = hull.size();
  const double reference = cross(hull[0] - hull[n - 1], p - hull[n - 1]);
  for (std::size_t i = 0; i < n; ++i)
    if (reference * cross(hull[(i + 1) % n] - hull[i], p - hull[i]) <= 0) return false;
  return true;
}

// Appendix A.9.2 as printed.
std::optional<DVec2> printed_crossing(const DVec2& m, const DVec2& n, const DVec2& p,
                                      const DVec2& q) {
  const double a1 = n.y - m.y, b1 = m.x - n.x, c1 = a1 * m.x + b1 * m.y;
  const double a2 = q.y - p.y, b2 = p.x - q.x, c2 = a2 * p.x + b2 * p.y;
  const double delta = a1 * b2 - a2 * b1;
  const DVec2 k((b2 * c1 - b1 * c2) / delta, (a1 * c2 - a2 * c1) / delta);
  const auto within = [&k](const DVec2& u, const DVec2& v) {
    const DVec2 low = glm::min(u, v), high = glm::max(u, v);
    return low.x <= k.x && high.x >= k.x && low.y <= k.y && high.y >= k.y;
  };
  if (within(m, n) && within(p, q)) return k;
  return std::nullopt;
}

// Appendix A.10 as printed: | x0 y1 ; y0 y1 | + ...
double printed_area(const ConvexPolygon& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const DVec2& q = p[(i + 1) % p.size()];
    sum += p[i].x * q.y - q.y * p[i].y;
  }
  return std::abs(sum / 2);
}

const ConvexPolygon square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

ConvexPolygon moved(ConvexPolygon p, const DVec2& by) {
  for (DVec2& v : p) v += by;
  return p;
}

}  // namespace

TEST_CASE("Orientation is exact where rounding decides nothing") {
  // Points within some ulps of a line through the origin: sums of integers tell the truth.
  std::mt19937 random(1);
  std::uniform_int_distribution<int> ulps(-8, 8);
  int naive_wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = std::numeric_limits<double>::epsilon();
    const int ax = ulps(random), ay = ulps(random);
    const DVec2 a(0.5 + ax * u, 0.5 + ay * u), b(12, 12), c(24, 24);
    // The line is x = y: the sign of ay - ax tells the side.
    const int expected = (ax > ay) - (ax < ay);  // right of b -> c is below the line
    REQUIRE(orientation(b, c, a) == -expected);
    const double naive = cross(b - a, c - a);
    naive_wrong += ((naive > 0) - (naive < 0)) != -expected;
  }
  CHECK(naive_wrong > 0);
}

TEST_CASE("A hull drops duplicates and collinear points") {
  const std::vector<DVec2> points{{0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2},
                                  {1, 1}, {2, 2}, {0, 0}, {0, 1}, {2, 1}};
  CHECK(convex_hull(points) == ConvexPolygon{{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  CHECK(convex_hull(std::vector<DVec2>{{1, 1}, {1, 1}}) == ConvexPolygon{{1, 1}});
  CHECK(convex_hull(std::vector<DVec2>{{0, 0}, {1, 1}, {2, 2}}).size() == 2);
  CHECK(convex_hull({}).empty());
}

// Errata, A.8 and algorithm A.4.
TEST_CASE("A polygon contains its boundary, whatever its vertices repeat") {
  const ConvexPolygon repeated{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {0, 0}};
  for (const DVec2& p : {DVec2(0, 0), DVec2(0.5, 0), DVec2(1, 0.25), DVec2(1, 1)}) {
    CHECK(contains(square, p));
    CHECK(contains(repeated, p));
    CHECK_FALSE(printed_inside(square, p));
  }
  CHECK(contains(repeated, DVec2(0.5)));
  CHECK_FALSE(printed_inside(repeated, DVec2(0.5)));  // a zero reference cross product
  CHECK_FALSE(contains(square, DVec2(1, std::nextafter(1.0, 2.0))));
  CHECK_FALSE(contains(square, DVec2(-5e-324, 0.5)));
  const ConvexPolygon segment{{0, 0}, {2, 2}};
  CHECK(contains(segment, DVec2(1, 1)));
  CHECK_FALSE(contains(segment, DVec2(3, 3)));
  CHECK_FALSE(contains(segment, DVec2(1, 1.5)));
  CHECK_FALSE(contains({}, DVec2(0)));
}

// Errata, A.9.
TEST_CASE("Identical, collinear, touching and contained polygons overlap as they should") {
  CHECK_FALSE(printed_inside(square, square[0]));
  CHECK(overlap_area(square, square) == 1);

  // Parallel, collinear edges: delta is 0 and the crossing is not a number.
  CHECK_FALSE(printed_crossing({0, 0}, {1, 0}, {0.5, 0}, {2, 0}).has_value());
  // The printed test misses a true crossing with a horizontal edge by one ulp.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  int missed = 0;
  for (int i = 1; i < 1000; ++i) {
    const double y = uniform(random);
    missed += !printed_crossing({0, y}, {1, y}, {uniform(random), y - uniform(random)},
                                {uniform(random), y + uniform(random)})
                   .has_value();
  }
  CHECK(missed > 0);

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

// Errata, A.10.
TEST_CASE("The shoelace formula is right, and keeps its digits far from the origin") {
  CHECK(area(square) == 1);
  CHECK(printed_area(square) == Approx(0.5));
  const ConvexPolygon small = moved({{0, 0}, {1e-3, 0}, {0, 1e-3}}, {1e7, 1e7});
  double naive = 0;
  for (std::size_t i = 0; i < 3; ++i) naive += cross(small[i], small[(i + 1) % 3]);
  CHECK(std::abs(naive / 2 / 0.5e-6 - 1) > 0.01);
  CHECK(area(small) == Approx(0.5e-6).epsilon(1e-5));  // the corners themselves are rounded
  CHECK(area(ConvexPolygon{{0, 0}, {1, 1}}) == 0);
}
