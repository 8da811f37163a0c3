#include <algorithm>
#include <cmath>
#include <pah/influence/influence_area.hpp>

#include "geometry/solid_angle.hpp"
#include "influence/visible_patches.hpp"

namespace pah {

namespace {

// A box relative to an origin, by its corners and by its center and half extent.
struct RelativeBox {
  RelativeBox(const Aabb& box, const DVec3& origin)
      : low(DVec3(box.min) - origin),
        high(DVec3(box.max) - origin),
        half(0.5 * (DVec3(box.max) - DVec3(box.min))),
        center(low + half) {}

  DVec3 low, high, half, center;

  // The smallest and largest dot product of a vector with the points of the box.
  [[nodiscard]] DVec2 range_along(const DVec3& v) const {
    const double middle = glm::dot(v, center);
    const double reach = glm::dot(glm::abs(v), half);
    return {middle - reach, middle + reach};
  }
};

enum class Placement { outside, crossing, inside };

// `range` holds the least and the largest distance of the box's points into a half-space.
Placement combine(Placement so_far, const DVec2& range) {
  if (so_far == Placement::outside || range.y < 0) return Placement::outside;
  return range.x < 0 ? Placement::crossing : so_far;
}

Placement place(const Obb& region, const RelativeBox& box) {
  Placement result = Placement::inside;
  for (int k = 0; k < 3; ++k) {
    const DVec2 range = box.range_along(region.axes[k]);
    const double h = region.half_size[k];
    result = combine(result, {h - range.y, h - range.x});
    result = combine(result, {h + range.x, h + range.y});
  }
  return result;
}

Placement place(const Frustum& region, const RelativeBox& box) {
  const DVec2 depth = box.range_along(region.axes[2]);
  Placement result = combine(Placement::inside, depth - region.near);
  result = combine(result, {region.far - depth.y, region.far - depth.x});
  for (int k = 0; k < 2; ++k) {
    const DVec3 side = region.tan_half[k] * region.axes[2];
    result = combine(result, box.range_along(side - region.axes[k]));
    result = combine(result, box.range_along(side + region.axes[k]));
  }
  // whole_area() divides by depth: its sign must be certain.
  if (result == Placement::inside && !(depth.x > 0)) return Placement::crossing;
  return result;
}

PictureFrame frame_of(const PlaneArea& area) {
  PictureFrame frame;
  for (int k = 0; k < 3; ++k) {
    const DMat3& axes = area.box.axes;
    frame.offset[static_cast<std::size_t>(k)] = {axes[0][k], axes[1][k], 0};
    frame.slope[static_cast<std::size_t>(k)] = {0, 0, axes[2][k]};
  }
  frame.half_size = area.box.half_size;
  frame.near = -area.box.half_size.z;
  frame.far = area.box.half_size.z;
  return frame;
}

PictureFrame frame_of(const PointArea& area) {
  PictureFrame frame;
  for (int k = 0; k < 3; ++k) {
    const DMat3& axes = area.frustum.axes;
    frame.slope[static_cast<std::size_t>(k)] = {axes[0][k], axes[1][k], axes[2][k]};
  }
  frame.half_size = area.frustum.tan_half;
  frame.near = area.frustum.near;
  frame.far = area.frustum.far;
  return frame;
}

double patch_area(std::span<const DVec2> patch, PointMeasure measure) {
  if (measure == PointMeasure::plane) return area(patch);
  double sum = 0;
  const DVec3 a(patch[0], 1);
  for (std::size_t i = 2; i < patch.size(); ++i) {
    const DVec2 u = patch[i - 1] - patch[0];
    const DVec2 v = patch[i] - patch[0];
    sum +=
        solid_angle(a, DVec3(patch[i - 1], 1), DVec3(patch[i], 1), std::abs(u.x * v.y - u.y * v.x));
  }
  return sum;
}

// The projected area of a box wholly inside the frustum: the sum over its seen faces, each split in
// two triangles. On the plane at unit distance a triangle's area is det(a, b, c) / (2 a_z b_z c_z).
// For an axis-aligned face the determinant is exactly its distance times its area.
double whole_area(const PointArea& area, const RelativeBox& box, const BoxSector& sector) {
  const DVec3& forward = area.frustum.axes[2];
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (sector[k] == 0) continue;
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    DVec3 p00(0);
    p00[k] = sector[k] > 0 ? box.high[k] : box.low[k];
    p00[u] = box.low[u];
    p00[v] = box.low[v];
    DVec3 p10 = p00;
    DVec3 p01 = p00;
    p10[u] = box.high[u];
    p01[v] = box.high[v];
    DVec3 p11 = p10;
    p11[v] = box.high[v];
    const double determinant = std::abs(p00[k]) * (2 * box.half[u]) * (2 * box.half[v]);
    if (area.measure == PointMeasure::solid_angle) {
      sum += solid_angle(p00, p10, p11, determinant) + solid_angle(p00, p11, p01, determinant);
    } else {
      const double ends = 1 / (glm::dot(forward, p00) * glm::dot(forward, p11));
      sum += 0.5 * determinant * ends * (1 / glm::dot(forward, p10) + 1 / glm::dot(forward, p01));
    }
  }
  return sum;
}

double whole_area(const PlaneArea& area, const RelativeBox& box) {
  const DVec3 d = glm::abs(area.box.axes[2]);
  const DVec3 size = 2.0 * box.half;
  return d.x * size.y * size.z + d.y * size.x * size.z + d.z * size.x * size.y;
}

bool eye_inside(const PointArea& area, const Aabb& box) {
  return sector_of_eye(area.frustum.eye, box).inside();
}

}  // namespace

double cross_section(const InfluenceArea& area) {
  if (const auto* plane = std::get_if<PlaneArea>(&area))
    return 4 * plane->box.half_size.x * plane->box.half_size.y;
  const auto& point = std::get<PointArea>(area);
  const DVec2& t = point.frustum.tan_half;
  if (point.measure == PointMeasure::plane) return 4 * t.x * t.y;
  return 4 * std::atan2(t.x * t.y, std::sqrt(1 + t.x * t.x + t.y * t.y));
}

double projected_area(const PlaneArea& area, const Aabb& box) {
  if (box.empty()) return 0;
  const RelativeBox relative(box, area.box.center);
  const Placement placement = place(area.box, relative);
  if (placement == Placement::outside) return 0;
  if (placement == Placement::inside) return whole_area(area, relative);
  double sum = 0;
  for_each_patch(frame_of(area), relative.low, relative.high, sector_of_direction(area.box.axes[2]),
                 [&](std::span<const DVec2> patch) { sum += pah::area(patch); });
  return std::min(sum, cross_section(area));
}

double projected_area(const PointArea& area, const Aabb& box) {
  if (box.empty()) return 0;
  if (eye_inside(area, box)) return cross_section(area);
  const RelativeBox relative(box, area.frustum.eye);
  const Placement placement = place(area.frustum, relative);
  if (placement == Placement::outside) return 0;
  const BoxSector sector = sector_of_eye(area.frustum.eye, box);
  if (placement == Placement::inside) return whole_area(area, relative, sector);
  double sum = 0;
  for_each_patch(frame_of(area), relative.low, relative.high, sector,
                 [&](std::span<const DVec2> patch) { sum += patch_area(patch, area.measure); });
  return std::min(sum, cross_section(area));
}

double projected_area(const InfluenceArea& area, const Aabb& box) {
  return std::visit([&](const auto& a) { return projected_area(a, box); }, area);
}

double hit_probability(const InfluenceArea& area, const Aabb& box) {
  return std::min(1.0, projected_area(area, box) / cross_section(area));
}

ConvexPolygon projected_hull(const InfluenceArea& area, const Aabb& box) {
  if (box.empty()) return {};
  std::vector<DVec2> points;
  const auto collect = [&](std::span<const DVec2> patch) {
    for (const DVec2& p : patch) points.push_back(p);
  };
  const auto outline = [&](const BoxSector& sector) {
    for (const std::uint8_t i : outline_from(sector).span())
      points.push_back(*project(area, DVec3(box.corner(i))));
  };
  if (const auto* plane = std::get_if<PlaneArea>(&area)) {
    const RelativeBox relative(box, plane->box.center);
    const BoxSector sector = sector_of_direction(plane->box.axes[2]);
    const Placement placement = place(plane->box, relative);
    if (placement == Placement::inside) outline(sector);
    if (placement == Placement::crossing)
      for_each_patch(frame_of(*plane), relative.low, relative.high, sector, collect);
  } else {
    const auto& point = std::get<PointArea>(area);
    const RelativeBox relative(box, point.frustum.eye);
    const BoxSector sector = sector_of_eye(point.frustum.eye, box);
    const Placement placement = place(point.frustum, relative);
    if (sector.inside())
      collect(Patch(point.frustum.tan_half).points());
    else if (placement == Placement::inside)
      outline(sector);
    else if (placement == Placement::crossing)
      for_each_patch(frame_of(point), relative.low, relative.high, sector, collect);
  }
  return convex_hull(points);
}

}  // namespace pah
