#include "report/inspect/pictures/line_set.hpp"

#include <algorithm>

#include "report/inspect/pictures/false_color.hpp"

namespace pah {
namespace {

// Bit k of a corner's number is set if the corner lies at the upper end of axis k.
DVec3 signs(unsigned corner) {
  return {(corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1, (corner & 4U) != 0 ? 1 : -1};
}

Vec3 corner_of(const Aabb& box, unsigned corner) { return box.corner(corner); }
Vec3 corner_of(const Obb& box, unsigned corner) {
  return Vec3(box.center + box.axes * (signs(corner) * box.half_size));
}
Vec3 corner_of(const Frustum& frustum, unsigned corner) {
  const DVec3 sign = signs(corner);
  const double z = sign.z > 0 ? frustum.far : frustum.near;
  return Vec3(frustum.eye + frustum.axes * (z * DVec3(sign.x * frustum.tan_half.x,
                                                      sign.y * frustum.tan_half.y, 1)));
}

}  // namespace

void add_edges(const Region& region, LineSet& lines) {
  constexpr unsigned corners = 8;
  const auto first = static_cast<std::uint32_t>(lines.positions.size());
  for (unsigned corner = 0; corner < corners; ++corner)
    lines.positions.push_back(
        std::visit([&](const auto& any) { return corner_of(any, corner); }, region));
  for (unsigned corner = 0; corner < corners; ++corner)
    for (unsigned bit = 1; bit < corners; bit *= 2) {
      const std::uint32_t a = first + corner, b = first + (corner | bit);
      if (lines.positions[a] != lines.positions[b]) lines.edges.push_back({a, b});
    }
}

std::vector<LineSet> level_lines(const std::vector<std::vector<Aabb>>& levels) {
  std::vector<LineSet> sets;
  const auto last = static_cast<double>(std::max<std::size_t>(levels.size(), 2) - 1);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LineSet& set = sets.emplace_back();
    set.name = "level " + std::to_string(i);
    set.color = false_color(0.25 + 0.5 * static_cast<double>(i) / last);
    for (const Aabb& box : levels[i]) add_edges(box, set);
  }
  return sets;
}

}  // namespace pah
