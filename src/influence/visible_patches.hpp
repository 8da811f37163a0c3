// The part of a box that a bundle of rays meets, as disjoint convex patches of the picture plane.
//
// A ray enters a box through a face that is turned towards it, or starts inside. So there is at
// most one patch for each of three faces, and one for the region's near face where it cuts the box.
// Everything that bounds a patch on a face's plane (the face's four edges, the near and the far
// plane) is linear in the picture coordinates. So each patch is the region's rectangle clipped by a
// few half-planes: nothing is projected or divided by a depth.
#pragma once

#include <algorithm>
#include <array>
#include <pah/influence/box_sectors.hpp>
#include <span>

namespace pah {

// The linear function x * X + y * Y + c of the picture plane's coordinates (X, Y).
struct Linear {
  double x = 0, y = 0, c = 0;

  [[nodiscard]] double operator()(const DVec2& p) const { return x * p.x + y * p.y + c; }
  friend Linear operator+(const Linear& a, const Linear& b) {
    return {a.x + b.x, a.y + b.y, a.c + b.c};
  }
  friend Linear operator-(const Linear& a, const Linear& b) {
    return {a.x - b.x, a.y - b.y, a.c - b.c};
  }
  friend Linear operator*(double s, const Linear& a) { return {s * a.x, s * a.y, s * a.c}; }
};

// A rectangle clipped by at most six half-planes: ten vertices at most.
class Patch {
 public:
  explicit Patch(const DVec2& half_size)
      : points_{{{-half_size.x, -half_size.y},
                 {half_size.x, -half_size.y},
                 {half_size.x, half_size.y},
                 {-half_size.x, half_size.y}}} {}

  // Keeps the part where keep >= 0 (Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974).
  void clip(const Linear& keep) {
    std::array<DVec2, capacity> kept{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const DVec2& p = points_[i];
      const DVec2& q = points_[i + 1 == size_ ? 0 : i + 1];
      const double a = keep(p);
      const double b = keep(q);
      // Rounding can make a sliver cross the line more than twice; dropping it loses no area.
      if (a >= 0 && count < capacity) kept[count++] = p;
      if (((a > 0 && b < 0) || (a < 0 && b > 0)) && count < capacity)
        kept[count++] = p + a / (a - b) * (q - p);
    }
    points_ = kept;
    size_ = count;
  }
  // As clip(), but keeps nothing if keep > 0 at no vertex.
  void clip_strictly(const Linear& keep) {
    const auto all = points();
    if (std::any_of(all.begin(), all.end(), [&](const DVec2& p) { return keep(p) > 0; }))
      clip(keep);
    else
      size_ = 0;
  }
  [[nodiscard]] std::span<const DVec2> points() const { return {points_.data(), size_}; }

 private:
  static constexpr std::size_t capacity = 12;
  std::array<DVec2, capacity> points_{};
  std::size_t size_ = 4;
};

// The rays of a region. At depth z a ray is at offset + z * slope, both linear in the picture
// plane. Parallel rays have constant slopes; rays through a point have no offset.
struct PictureFrame {
  std::array<Linear, 3> offset, slope;  // by world axis, relative to the region's origin
  DVec2 half_size{1};
  double near = 0, far = 1;
};

// Calls visit(patch) for every patch of the box [low, high], which is relative to the region's
// origin.
template <typename Visit>
void for_each_patch(const PictureFrame& frame, const DVec3& low, const DVec3& high,
                    const BoxSector& sector, Visit visit) {
  // A product of s or t below: one of the two factors is constant.
  const auto times = [](const Linear& a, const Linear& b) {
    return b.x == 0 && b.y == 0 ? b.c * a : a.c * b;
  };
  const int flat = (low.x == high.x) + (low.y == high.y) + (low.z == high.z);
  Patch cap(frame.half_size);  // the rays that start inside the box
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const Linear start = frame.offset[axis] + frame.near * frame.slope[axis];
    const Linear above_low = start - Linear{0, 0, low[k]};
    const Linear below_high = Linear{0, 0, high[k]} - start;
    const int side = sector[k];
    if (side >= 0) cap.clip(above_low);
    if (side <= 0) cap.clip(below_high);
    if (side == 0 || flat - (low[k] == high[k]) > 0) continue;  // a face without area
    // Rays meet the face's plane at depth t / s, and enter the box there if s > 0.
    const double face = side > 0 ? high[k] : low[k];
    const Linear s = -side * frame.slope[axis];
    const Linear t = side * (frame.offset[axis] - Linear{0, 0, face});
    Patch patch(frame.half_size);
    // A ray either enters through the face or starts beyond it. Both tests use the same number, so
    // no ray counts twice.
    const Linear started_beyond = side > 0 ? below_high : above_low;
    cap.clip_strictly(started_beyond);
    patch.clip(-1 * started_beyond);
    patch.clip(frame.far * s - t);
    for (int j = 0; j < 3; ++j) {
      if (j == k) continue;
      const auto other = static_cast<std::size_t>(j);
      const Linear at = times(frame.offset[other], s) + times(frame.slope[other], t);
      patch.clip(at - low[j] * s);
      patch.clip(high[j] * s - at);
    }
    if (patch.points().size() >= 3) visit(patch.points());
  }
  if (flat == 0 && cap.points().size() >= 3) visit(cap.points());
}

}  // namespace pah
