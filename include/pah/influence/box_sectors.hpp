// The sector of space around a box in which an eye lies, and the box's outline as seen from there.
//
// Along each axis an eye is below the box (-1), above it (1) or between its faces (0). That makes
// 27 sectors; the middle one is the box itself. Corner i of a box takes max.x if bit 0 of i is set,
// max.y if bit 1 is, max.z if bit 2 is.
#pragma once

#include <array>
#include <cstdint>
#include <pah/geometry/aabb.hpp>
#include <span>

namespace pah {

struct BoxSector {
  int x = 0, y = 0, z = 0;  // each -1, 0 or 1

  [[nodiscard]] constexpr int operator[](int axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }
  [[nodiscard]] constexpr std::size_t index() const {
    return static_cast<std::size_t>((x + 1) + 3 * (y + 1) + 9 * (z + 1));
  }
  [[nodiscard]] constexpr bool inside() const { return x == 0 && y == 0 && z == 0; }
  friend constexpr bool operator==(const BoxSector&, const BoxSector&) = default;
};

// The sector of an eye. An eye on a face's plane counts as between the faces.
[[nodiscard]] inline BoxSector sector_of_eye(const DVec3& eye, const Aabb& box) {
  const auto side = [&](int k) {
    return static_cast<int>(eye[k] > box.max[k]) - static_cast<int>(eye[k] < box.min[k]);
  };
  return {side(0), side(1), side(2)};
}

// The sector of an eye infinitely far away from which rays travel along `direction`.
[[nodiscard]] inline BoxSector sector_of_direction(const DVec3& direction) {
  const auto side = [&](int k) {
    return static_cast<int>(direction[k] < 0) - static_cast<int>(direction[k] > 0);
  };
  return {side(0), side(1), side(2)};
}

// Corners in order: 4 if one face is seen, 6 if two or three are, none from inside.
struct BoxOutline {
  std::array<std::uint8_t, 6> corners{};
  int size = 0;

  [[nodiscard]] constexpr std::span<const std::uint8_t> span() const {
    return {corners.data(), static_cast<std::size_t>(size)};
  }
};

namespace detail {

// The outline consists of the edges between a seen and an unseen face. Seen faces are all walked in
// the same sense, so that two neighbors walk their common edge in opposite directions.
constexpr BoxOutline make_outline(BoxSector sector) {
  // The four corners around the face on side 0 or 1 of axis k, counter-clockwise in the two
  // coordinates of a right-handed frame (right, up, forward) in which forward leads to the face.
  const auto face_corner = [](int k, int side, int i) {
    constexpr std::array<int, 4> first{0, 1, 1, 0};
    constexpr std::array<int, 4> second{0, 0, 1, 1};
    const auto n = static_cast<std::size_t>(side == 0 ? i : 3 - i);
    return (side << k) | (first[n] << ((k + 1) % 3)) | (second[n] << ((k + 2) % 3));
  };
  std::array<std::array<bool, 8>, 8> walked{};
  for (int k = 0; k < 3; ++k) {
    if (sector[k] == 0) continue;
    const int side = sector[k] > 0 ? 1 : 0;
    for (int i = 0; i < 4; ++i)
      walked[static_cast<std::size_t>(face_corner(k, side, i))]
            [static_cast<std::size_t>(face_corner(k, side, (i + 1) % 4))] = true;
  }
  std::array<int, 8> next{-1, -1, -1, -1, -1, -1, -1, -1};
  int start = -1;
  for (int from = 7; from >= 0; --from)
    for (int to = 0; to < 8; ++to) {
      const auto a = static_cast<std::size_t>(from);
      const auto b = static_cast<std::size_t>(to);
      if (!walked[a][b] || walked[b][a]) continue;
      next[a] = to;
      start = from;
    }
  BoxOutline outline;
  if (start < 0) return outline;
  int corner = start;
  do {
    outline.corners[static_cast<std::size_t>(outline.size++)] = static_cast<std::uint8_t>(corner);
    corner = next[static_cast<std::size_t>(corner)];
  } while (corner != start);
  return outline;
}

constexpr std::array<BoxOutline, 27> make_outlines() {
  std::array<BoxOutline, 27> table{};
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const BoxSector sector{x, y, z};
        table[sector.index()] = make_outline(sector);
      }
  return table;
}

inline constexpr std::array<BoxOutline, 27> outlines = make_outlines();

}  // namespace detail

// The outline of a box, counter-clockwise in the first two coordinates of any right-handed frame
// (right, up, forward) whose third axis leads away from the eye.
[[nodiscard]] constexpr const BoxOutline& outline_from(BoxSector sector) {
  return detail::outlines[sector.index()];
}

}  // namespace pah
