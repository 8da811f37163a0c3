#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <pah/geometry/convex_polygon.hpp>

#include "geometry/rounding.hpp"

namespace pah {

namespace {

double cross(const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; }

int sign(double x) { return (x > 0) - (x < 0); }

// A sum without rounding: an expansion of nonoverlapping floating-point components of increasing
// magnitude. Shewchuk, "Adaptive Precision Floating-Point Arithmetic", 1997, figure 6.
class ExactSum {
 public:
  void add(double x) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + terms_[i];
      const double part = sum - x;
      terms_[i] = (x - (sum - part)) + (terms_[i] - part);
      x = sum;
    }
    terms_[size_++] = x;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  [[nodiscard]] int sign_of_sum() const {
    for (std::size_t i = size_; i-- > 0;)
      if (terms_[i] != 0) return sign(terms_[i]);
    return 0;
  }

 private:
  std::array<double, 12> terms_;
  std::size_t size_ = 0;
};

int exact_orientation(const DVec2& a, const DVec2& b, const DVec2& c) {
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.x, c.y);
  sum.add_product(-c.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(a.y, c.x);
  sum.add_product(c.y, b.x);
  return sum.sign_of_sum();
}

bool lexicographically_less(const DVec2& a, const DVec2& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

// The part of the polygon left of a -> b or on it. Sutherland and Hodgman, "Reentrant Polygon
// Clipping", 1974.
ConvexPolygon clip_left(const ConvexPolygon& polygon, const DVec2& a, const DVec2& b) {
  ConvexPolygon result;
  result.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec2& p = polygon[i];
    const DVec2& q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const int p_side = orientation(a, b, p);
    const int q_side = orientation(a, b, q);
    if (p_side >= 0) result.push_back(p);
    if (p_side * q_side < 0) {
      // Distances may both round to 0 although their exact signs differ.
      const double p_distance = std::abs(cross(b - a, p - a));
      const double q_distance = std::abs(cross(b - a, q - a));
      const double sum = p_distance + q_distance;
      const double t = sum > 0 ? p_distance / sum : 0.5;
      result.push_back(t < 0.5 ? p + t * (q - p) : q + (1 - t) * (p - q));
    }
  }
  return result;
}

ConvexPolygon moved(const ConvexPolygon& polygon, const DVec2& offset) {
  ConvexPolygon result = polygon;
  for (DVec2& p : result) p += offset;
  return result;
}

}  // namespace

int orientation(const DVec2& a, const DVec2& b, const DVec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  // Shewchuk 1997, figure 21: ccwerrboundA.
  constexpr double bound = (3 + 16 * double_unit_roundoff) * double_unit_roundoff;
  if (std::abs(determinant) > bound * (std::abs(left) + std::abs(right))) return sign(determinant);
  return exact_orientation(a, b, c);
}

// Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
ConvexPolygon convex_hull(std::span<const DVec2> points) {
  std::vector<DVec2> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), lexicographically_less);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  ConvexPolygon hull;
  const auto add_chain = [&hull](auto first, const auto& last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= start + 2 &&
             orientation(hull[hull.size() - 2], hull.back(), *first) <= 0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // the first of the next chain
  };
  add_chain(sorted.begin(), sorted.end());
  add_chain(sorted.rbegin(), sorted.rend());
  return hull;
}

double area(std::span<const DVec2> polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * std::abs(twice);
}

bool contains(std::span<const DVec2> polygon, const DVec2& point) {
  if (polygon.empty()) return false;
  // A polygon without area has no inside: the point must also lie between its ends.
  DVec2 low = polygon[0];
  DVec2 high = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (orientation(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1], point) < 0)
      return false;
    low = glm::min(low, polygon[i]);
    high = glm::max(high, polygon[i]);
  }
  return low.x <= point.x && point.x <= high.x && low.y <= point.y && point.y <= high.y;
}

ConvexPolygon intersection(const ConvexPolygon& a, const ConvexPolygon& b) {
  ConvexPolygon result = a;
  for (std::size_t i = 0; i < b.size() && !result.empty(); ++i) {
    const DVec2& next = b[i + 1 == b.size() ? 0 : i + 1];
    if (b[i] != next) result = clip_left(result, b[i], next);
  }
  return result;
}

double overlap_area(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (a.size() < 3 || b.size() < 3) return 0;
  // A fixed order of the arguments makes the result symmetric. The smaller polygon is clipped,
  // relative to its first vertex, so that rounding is relative to its size.
  const double a_area = area(a);
  const double b_area = area(b);
  if (b_area < a_area ||
      (b_area == a_area && std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end(),
                                                        lexicographically_less)))
    return overlap_area(b, a);
  const DVec2 origin = a[0];
  const ConvexPolygon common = intersection(moved(a, -origin), moved(b, -origin));
  return std::min(area(common), a_area);
}

}  // namespace pah
