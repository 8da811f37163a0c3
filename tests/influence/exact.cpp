#include "exact.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>

namespace exact_answer {

namespace {

using namespace pah;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point2 = Kernel::Point_2;
using Polygon2 = CGAL::Polygon_2<Kernel>;
using Point = std::array<Number, 3>;
using Face = std::vector<Point>;

Point exactly(const DVec3& v) { return {Number(v.x), Number(v.y), Number(v.z)}; }

Number dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Frame {
  Point origin;
  std::array<Point, 3> axes;

  [[nodiscard]] Point to_local(const Point& p) const {
    const Point d{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    return {dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])};
  }
};

Frame make_frame(const DVec3& origin, const DMat3& axes) {
  return {exactly(origin), {exactly(axes[0]), exactly(axes[1]), exactly(axes[2])}};
}
Frame frame_of(const Aabb& /*box*/) { return make_frame(DVec3(0), DMat3(1.0)); }
Frame frame_of(const Obb& b) { return make_frame(b.center, b.axes); }
Frame frame_of(const Frustum& f) { return make_frame(f.eye, f.axes); }
Frame frame_of(const Region& region) {
  return std::visit([](const auto& r) { return frame_of(r); }, region);
}

// A region as half-spaces n . q + d >= 0 in its local coordinates.
struct HalfSpace {
  Point normal;
  Number offset;

  [[nodiscard]] Number operator()(const Point& q) const { return dot(normal, q) + offset; }
};
std::vector<HalfSpace> slab(int axis, const Number& low, const Number& high) {
  Point up{0, 0, 0}, down{0, 0, 0};
  up[static_cast<std::size_t>(axis)] = 1;
  down[static_cast<std::size_t>(axis)] = -1;
  return {{up, -low}, {down, high}};
}
std::vector<HalfSpace> slabs(const std::array<Number, 3>& low, const std::array<Number, 3>& high) {
  std::vector<HalfSpace> all;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    for (HalfSpace& h : slab(k, low[i], high[i])) all.push_back(std::move(h));
  }
  return all;
}
std::vector<HalfSpace> half_spaces(const Aabb& b) {
  return slabs(exactly(DVec3(b.min)), exactly(DVec3(b.max)));
}
std::vector<HalfSpace> half_spaces(const Obb& b) {
  return slabs(exactly(-b.half_size), exactly(b.half_size));
}
std::vector<HalfSpace> half_spaces(const Frustum& f) {
  std::vector<HalfSpace> all = slab(2, f.near, f.far);
  const Number tx = f.tan_half.x;
  const Number ty = f.tan_half.y;
  all.push_back({{-1, 0, tx}, 0});
  all.push_back({{1, 0, tx}, 0});
  all.push_back({{0, -1, ty}, 0});
  all.push_back({{0, 1, ty}, 0});
  return all;
}
std::vector<HalfSpace> half_spaces(const Region& region) {
  return std::visit([](const auto& r) { return half_spaces(r); }, region);
}

// The closed common part of a convex polygon, segment or point with a half-space.
Face clip(const Face& face, const HalfSpace& keep) {
  Face result;
  std::vector<Number> distance;
  for (const Point& p : face) distance.push_back(keep(p));
  for (std::size_t i = 0; i < face.size(); ++i) {
    const std::size_t j = (i + 1) % face.size();
    const CGAL::Sign a = CGAL::sign(distance[i]);
    const CGAL::Sign b = CGAL::sign(distance[j]);
    if (a != CGAL::NEGATIVE) result.push_back(face[i]);
    if (a * b == CGAL::NEGATIVE) {
      const Number t = distance[i] / (distance[i] - distance[j]);
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = face[i][k] + t * (face[j][k] - face[i][k]);
      result.push_back(p);
    }
  }
  return result;
}
Face clip(Face face, const std::vector<HalfSpace>& all) {
  for (const HalfSpace& h : all) {
    if (face.empty()) break;
    face = clip(face, h);
  }
  return face;
}

std::vector<Face> faces_of(const Aabb& box, const Frame& frame) {
  std::vector<Face> faces;
  for (unsigned k = 0; k < 3; ++k)
    for (unsigned side = 0; side < 2; ++side) {
      const unsigned u = 1U << ((k + 1) % 3), v = 1U << ((k + 2) % 3), base = side << k;
      Face face;
      for (const unsigned corner : {base, base | u, base | u | v, base | v})
        face.push_back(frame.to_local(exactly(pah::DVec3(box.corner(corner)))));
      faces.push_back(std::move(face));
    }
  return faces;
}

// The corners of a region, in its local coordinates.
std::vector<Point> corners_of(const Region& region) {
  std::vector<Point> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const auto pick = [i](unsigned k, const auto& low, const auto& high) {
      return Number((i >> k & 1U) != 0 ? high : low);
    };
    if (const auto* b = std::get_if<Aabb>(&region)) {
      corners.push_back(exactly(pah::DVec3(b->corner(i))));
    } else if (const auto* o = std::get_if<Obb>(&region)) {
      const DVec3& h = o->half_size;
      corners.push_back({pick(0, -h.x, h.x), pick(1, -h.y, h.y), pick(2, -h.z, h.z)});
    } else {
      const auto& f = std::get<Frustum>(region);
      const Number z = pick(2, f.near, f.far);
      corners.push_back(
          {z * pick(0, -f.tan_half.x, f.tan_half.x), z * pick(1, -f.tan_half.y, f.tan_half.y), z});
    }
  }
  return corners;
}

// A point given in local coordinates.
Point to_world(const Frame& frame, const Point& q) {
  // Solve axes^T (p - origin) = q by Cramer's rule.
  const auto& a = frame.axes;
  const auto cross = [](const Point& u, const Point& v) {
    return Point{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const Point yz = cross(a[1], a[2]), zx = cross(a[2], a[0]), xy = cross(a[0], a[1]);
  const Number determinant = dot(a[0], yz);
  Point p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = frame.origin[k] + (q[0] * yz[k] + q[1] * zx[k] + q[2] * xy[k]) / determinant;
  return p;
}

bool in_box(const Aabb& box, const Point& p) {
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (p[i] < Number(box.min[k]) || p[i] > Number(box.max[k])) return false;
  }
  return true;
}

Point2 project(const InfluenceArea& area, const Point& q) {
  if (std::holds_alternative<PlaneArea>(area)) return {q[0], q[1]};
  return {q[0] / q[2], q[1] / q[2]};
}

Polygon2 hull_of(const std::vector<Point2>& points) {
  Polygon2 hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  return hull;
}

double measure(const InfluenceArea& area, const Polygon2& hull) {
  if (hull.size() < 3) return 0;
  const auto* point = std::get_if<PointArea>(&area);
  if (point == nullptr || point->measure == PointMeasure::plane)
    return CGAL::to_double(hull.area());
  double sum = 0;
  const auto vector = [](const Point2& p) {
    return DVec3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), 1);
  };
  for (std::size_t i = 2; i < hull.size(); ++i) {
    const DVec3 a = vector(hull[0]), b = vector(hull[i - 1]), c = vector(hull[i]);
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double determinant = 2 * CGAL::to_double(CGAL::area(hull[0], hull[i - 1], hull[i]));
    sum += 2 * std::atan2(determinant, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb +
                                           glm::dot(b, c) * la);
  }
  return sum;
}

Polygon2 polygon_of(const ConvexPolygon& polygon) {
  std::vector<Point2> points;
  for (const DVec2& p : polygon) points.emplace_back(p.x, p.y);
  return hull_of(points);
}

}  // namespace

bool is_projected_hull(const InfluenceArea& area, const Aabb& box,
                       std::span<const std::uint8_t> corners) {
  const Frame frame = frame_of(region_of(area));
  std::vector<Point2> points;
  for (unsigned i = 0; i < 8; ++i)
    points.push_back(project(area, frame.to_local(exactly(pah::DVec3(box.corner(i))))));
  Polygon2 outline;
  for (const std::uint8_t i : corners) outline.push_back(points[i]);
  return outline.area() == hull_of(points).area();  // the first is signed
}

double projected_area(const InfluenceArea& area, const Aabb& box) {
  if (box.empty()) return 0;
  const Region region = region_of(area);
  const Frame frame = frame_of(region);
  std::vector<Point2> points;
  if (std::holds_alternative<PointArea>(area) && in_box(box, frame.origin)) {
    const DVec2& t = std::get<PointArea>(area).frustum.tan_half;
    return measure(area, polygon_of({{-t.x, -t.y}, {t.x, -t.y}, {t.x, t.y}, {-t.x, t.y}}));
  }
  const std::vector<HalfSpace> bounds = half_spaces(region);
  for (const Face& face : faces_of(box, frame))
    for (const Point& q : clip(face, bounds)) points.push_back(project(area, q));
  for (const Point& q : corners_of(region))
    if (in_box(box, to_world(frame, q))) points.push_back(project(area, q));
  return measure(area, hull_of(points));
}

bool contains(const Region& region, const Vec3& point) {
  const Point q = frame_of(region).to_local(exactly(DVec3(point)));
  const std::vector<HalfSpace> all = half_spaces(region);
  return std::all_of(all.begin(), all.end(), [&](const HalfSpace& h) { return h(q) >= Number(0); });
}

bool contains(const ConvexPolygon& polygon, const DVec2& point) {
  Polygon2 p;
  for (const DVec2& v : polygon) p.push_back({v.x, v.y});
  return p.bounded_side({point.x, point.y}) != CGAL::ON_UNBOUNDED_SIDE;
}

bool overlaps(const Region& region, const Aabb& box) {
  const Frame frame = frame_of(region);
  const std::vector<HalfSpace> bounds = half_spaces(region);
  for (const Face& face : faces_of(box, frame))
    if (!clip(face, bounds).empty()) return true;
  return in_box(box, to_world(frame, corners_of(region)[0]));
}

bool overlaps(const Region& region, const Triangle& triangle) {
  const Frame frame = frame_of(region);
  const Face face{frame.to_local(exactly(DVec3(triangle.a))),
                  frame.to_local(exactly(DVec3(triangle.b))),
                  frame.to_local(exactly(DVec3(triangle.c)))};
  return !clip(face, half_spaces(region)).empty();
}

ConvexPolygon convex_hull(std::span<const DVec2> points) {
  const Polygon2 hull = polygon_of({points.begin(), points.end()});
  ConvexPolygon result;
  for (const Point2& p : hull.vertices())
    result.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
  return result;
}

double area(const ConvexPolygon& polygon) {
  const Polygon2 hull = polygon_of(polygon);
  return hull.size() < 3 ? 0 : CGAL::to_double(hull.area());
}

double overlap_area(const ConvexPolygon& a, const ConvexPolygon& b) {
  const Polygon2 p = polygon_of(a);
  const Polygon2 q = polygon_of(b);
  if (p.size() < 3 || q.size() < 3) return 0;
  std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
  CGAL::intersection(p, q, std::back_inserter(parts));
  Number sum = 0;
  for (const auto& part : parts) sum += part.outer_boundary().area();
  return CGAL::to_double(sum);
}

}  // namespace exact_answer
