#include "light_space/reach.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel_for.hpp"
#include "light_space/walk.hpp"

namespace pah {

namespace {

constexpr float nothing_near = std::numeric_limits<float>::infinity();

float nearest_in(const LightGrid& grid, const GridTile& tile) {
  float nearest = nothing_near;
  for (std::uint32_t i = 0; i < tile.across * tile.across; ++i) {
    const GridCell& cell = grid.cells[tile.first_cell + i];
    if (cell.count > 0)
      nearest = std::min(nearest, std::bit_cast<float>(grid.lists[std::size_t{3} * cell.first]));
  }
  return nearest;
}

// to[i] becomes the least of from[i - reach] ... from[i + reach], along a line of `count` values
// that are `stride` apart.
void spread_along(const std::vector<float>& from, std::vector<float>& to, std::size_t first,
                  std::size_t count, std::size_t stride, std::size_t reach) {
  for (std::size_t i = 0; i < count; ++i) {
    float least = nothing_near;
    for (std::size_t k = i - std::min(i, reach); k <= std::min(i + reach, count - 1); ++k)
      least = std::min(least, from[first + k * stride]);
    to[first + i * stride] = least;
  }
}

}  // namespace

void find_reach(LightGrid& grid, float tangent) {
  const GridFace& face = grid.faces[0];
  const std::size_t columns = face.columns, rows = face.rows;
  std::vector<float> nearest(columns * rows);
  parallel_for(nearest.size(), 256,
               [&](std::size_t i) { nearest[i] = nearest_in(grid, grid.tiles[i]); });
  const float all = std::ranges::min(nearest);
  // Rays start within the box, so none rises by more than its diagonal. Two tiles cover roundings.
  const double rise = glm::length(DVec3(grid.origins.max) - DVec3(grid.origins.min));
  const double tiles = double{tangent_allowance} * tangent * rise * face.per_length + 2;
  // Beyond this reach the least depth around a tile is slow to find and hardly ever useful.
  constexpr double farthest = 64;
  if (tiles <= farthest) {
    const auto reach = static_cast<std::size_t>(tiles);
    std::vector<float> spread(nearest.size());
    parallel_for(rows, 4, [&](std::size_t row) {
      spread_along(nearest, spread, row * columns, columns, 1, reach);
    });
    parallel_for(columns, 4, [&](std::size_t column) {
      spread_along(spread, nearest, column, rows, columns, reach);
    });
  } else {
    std::ranges::fill(nearest, all);
  }
  for (std::size_t i = 0; i < nearest.size(); ++i) grid.tiles[i].nearest = nearest[i];
  grid.tiles.back().nearest = all;
}

}  // namespace pah
