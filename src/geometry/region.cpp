#include <algorithm>
#include <cmath>
#include <pah/geometry/region.hpp>

#include "geometry/rounding.hpp"

namespace pah {

namespace {

// Local coordinates are dot products of a rounded difference with axes that are orthonormal up to
// rounding. Inside the region their error is below 4 + 3 + 4 unit roundoffs of its extent. One
// slack covers that. shape_of() pushes vertices out by four: for the errors of a segment's two
// ends, of an exit distance, and of the vertices.
double rounding_slack(double extent) { return 16 * double_unit_roundoff * extent; }

double extent_of(const Obb& b) { return b.half_size.x + b.half_size.y + b.half_size.z; }
double extent_of(const Frustum& f) { return f.far * (1 + f.tan_half.x + f.tan_half.y); }

// |(1, t)|: converts a distance from a frustum's side plane to units of its normal (1, t).
DVec2 side_lengths(const Frustum& f) {
  return {std::sqrt(1 + f.tan_half.x * f.tan_half.x), std::sqrt(1 + f.tan_half.y * f.tan_half.y)};
}

DVec3 to_local(const DMat3& axes, const DVec3& v) {
  return {glm::dot(axes[0], v), glm::dot(axes[1], v), glm::dot(axes[2], v)};
}

// The distance of a local point from each face; negative outside.
using Margins = std::array<double, 6>;

Margins margins(const Obb& b, const DVec3& q, double slack) {
  const DVec3 h = b.half_size + slack;
  return {h.x - q.x, h.x + q.x, h.y - q.y, h.y + q.y, h.z - q.z, h.z + q.z};
}
Margins margins(const Frustum& f, const DVec3& q, double slack) {
  const DVec2 side = f.tan_half * q.z + slack * side_lengths(f);
  return {side.x - q.x, side.x + q.x,        side.y - q.y,
          side.y + q.y, f.far + slack - q.z, q.z - f.near + slack};
}
// The change of the margins along a local direction.
Margins slopes(const Obb& /*region*/, const DVec3& d) { return {-d.x, d.x, -d.y, d.y, -d.z, d.z}; }
Margins slopes(const Frustum& f, const DVec3& d) {
  const DVec2 side = f.tan_half * d.z;
  return {side.x - d.x, side.x + d.x, side.y - d.y, side.y + d.y, -d.z, d.z};
}
// The largest error of a slope for a direction of unit length.
double slope_scale(const Obb& /*region*/) { return 1; }
double slope_scale(const Frustum& f) { return 1 + std::max(f.tan_half.x, f.tan_half.y); }

const DVec3& origin_of(const Obb& b) { return b.center; }
const DVec3& origin_of(const Frustum& f) { return f.eye; }

bool all_non_negative(const Margins& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return x >= 0; });
}

template <typename R>
bool contains_point(const R& region, const Vec3& point) {
  const DVec3 q = to_local(region.axes, DVec3(point) - origin_of(region));
  return all_non_negative(margins(region, q, rounding_slack(extent_of(region))));
}

float round_down(double t) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (t >= largest) return std::numeric_limits<float>::max();
  const auto f = static_cast<float>(t);
  return f > t ? std::nextafterf(f, 0.0F) : f;
}

template <typename R>
float exit_of(const R& region, const Ray& ray) {
  const DVec3 q = to_local(region.axes, DVec3(ray.origin) - origin_of(region));
  const DVec3 d = to_local(region.axes, DVec3(ray.direction));
  const Margins room = margins(region, q, rounding_slack(extent_of(region)));
  if (!all_non_negative(room)) return 0;
  const Margins slope = slopes(region, d);
  const DVec3 size = glm::abs(DVec3(ray.direction));
  const double error = 16 * double_unit_roundoff * slope_scale(region) * (size.x + size.y + size.z);
  double exit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < room.size(); ++i) {
    const double approach = error - slope[i];
    if (approach > 0) exit = std::min(exit, room[i] / approach);
  }
  return round_down(exit);
}

float exit_of(const Aabb& box, const Ray& ray) {
  if (!contains(box, ray.origin)) return 0;
  double exit = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k];
    if (d == 0) continue;
    const double face = d > 0 ? box.max[k] : box.min[k];
    // Difference and quotient each round once.
    exit = std::min(exit, (face - ray.origin[k]) / d * (1 - 4 * double_unit_roundoff));
  }
  return round_down(exit);
}

Vec3 round_down(const DVec3& v) {
  constexpr float lowest = -std::numeric_limits<float>::infinity();
  Vec3 f(v);
  for (int k = 0; k < 3; ++k)
    if (f[k] > v[k]) f[k] = std::nextafterf(f[k], lowest);
  return f;
}

// Fills in the corners, in the order of Aabb::corner(), and the box around them.
template <typename Corner>
void fill_vertices(RegionShape& shape, const DVec3& origin, Corner corner) {
  shape.origin = origin;
  DVec3 low(std::numeric_limits<double>::infinity());
  DVec3 high = -low;
  for (std::size_t i = 0; i < 8; ++i) {
    const DVec3 v = corner(DVec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0));
    shape.vertices[i] = v;
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  // Adding the origin rounds once more.
  const DVec3 slack = 2 * double_unit_roundoff * (glm::abs(origin) + glm::max(glm::abs(low), high));
  shape.box.min = round_down(origin + low - slack);
  shape.box.max = -round_down(-(origin + high + slack));
}

RegionShape make_shape(const Aabb& box, double dilation) {
  RegionShape shape;
  shape.box = {round_down(DVec3(box.min) - dilation), -round_down(-(DVec3(box.max) + dilation))};
  for (unsigned i = 0; i < 8; ++i) shape.vertices[i] = shape.box.corner(i);
  shape.normals = {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};
  shape.edges = shape.normals;
  shape.normal_count = shape.edge_count = 3;
  return shape;
}

RegionShape make_shape(const Obb& b, double dilation) {
  RegionShape shape;
  const DVec3 h = b.half_size + (dilation + 4 * rounding_slack(extent_of(b) + dilation));
  fill_vertices(shape, b.center,
                [&](const DVec3& s) { return b.axes * (h * DVec3(s.x, s.y, 2 * s.z - 1)); });
  shape.normals = {b.axes[0], b.axes[1], b.axes[2]};
  shape.edges = shape.normals;
  shape.normal_count = shape.edge_count = 3;
  return shape;
}

RegionShape make_shape(const Frustum& f, double dilation) {
  RegionShape shape;
  const double slack = dilation + 4 * rounding_slack(extent_of(f) + dilation);
  const DVec2 side_slack = slack * side_lengths(f);
  fill_vertices(shape, f.eye, [&](const DVec3& s) {
    const double z = s.z != 0 ? f.far + slack : f.near - slack;
    const DVec2 half = glm::max(f.tan_half * z + side_slack, 0.0);
    return f.axes * DVec3(s.x * half.x, s.y * half.y, z);
  });
  const double tx = f.tan_half.x;
  const double ty = f.tan_half.y;
  shape.normals = {f.axes[2], f.axes * DVec3(1, 0, -tx), f.axes * DVec3(1, 0, tx),
                   f.axes * DVec3(0, 1, -ty), f.axes * DVec3(0, 1, ty)};
  shape.normal_count = 5;
  shape.edges = {f.axes[0],
                 f.axes[1],
                 f.axes * DVec3(tx, ty, 1),
                 f.axes * DVec3(-tx, ty, 1),
                 f.axes * DVec3(tx, -ty, 1),
                 f.axes * DVec3(-tx, -ty, 1)};
  shape.edge_count = 6;
  return shape;
}

}  // namespace

bool contains(const Aabb& region, const Vec3& p) {
  return region.min.x <= p.x && p.x <= region.max.x && region.min.y <= p.y && p.y <= region.max.y &&
         region.min.z <= p.z && p.z <= region.max.z;
}
bool contains(const Obb& region, const Vec3& point) { return contains_point(region, point); }
bool contains(const Frustum& region, const Vec3& point) { return contains_point(region, point); }

bool contains(const Region& region, const Vec3& point) {
  return std::visit([&](const auto& r) { return contains(r, point); }, region);
}

bool contains(const Region& region, const Aabb& box) {
  if (box.empty()) return true;
  for (unsigned i = 0; i < 8; ++i)
    if (!contains(region, box.corner(i))) return false;
  return true;
}

float exit_distance(const Region& region, const Ray& ray) {
  return std::visit([&](const auto& r) { return exit_of(r, ray); }, region);
}

RegionShape shape_of(const Region& region, double dilation) {
  return std::visit([=](const auto& r) { return make_shape(r, dilation); }, region);
}

Aabb enclosing_box(const Region& region) { return shape_of(region).box; }

}  // namespace pah
