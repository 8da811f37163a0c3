#include "light_space/cell_entries.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel_for.hpp"

namespace pah {

namespace {

std::uint32_t* list_of(LightGrid& grid, const GridCell& cell) {
  return &grid.lists[std::size_t{3} * cell.first];
}
void write(std::uint32_t* list, std::size_t count, std::size_t at, const CellEntry& entry) {
  list[at] = std::bit_cast<std::uint32_t>(entry.nearest);
  list[count + at] = entry.places;
  list[2 * count + at] = entry.block;
}
void sort(std::uint32_t* list, std::size_t count, std::vector<CellEntry>& entries) {
  entries.clear();
  for (std::size_t k = 0; k < count; ++k)
    entries.push_back({std::bit_cast<float>(list[k]), list[count + k], list[2 * count + k]});
  std::ranges::sort(entries, {}, [](const CellEntry& e) { return std::pair(e.nearest, e.block); });
  for (std::size_t k = 0; k < count; ++k) write(list, count, k, entries[k]);
}

}  // namespace

void CellEntries::sort_into(LightGrid& grid) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const std::uint32_t count = counts_[i].exchange(0, std::memory_order_relaxed);
    grid.cells[i] = {sum, count};
    sum += count;
  }
  grid.lists.resize(std::size_t{3} * sum + LightGrid::read_beyond);
  parallel_for(placed_.size(), 1, [&](std::size_t task) {
    for (const Placed& placed : placed_[task]) {
      const std::uint32_t before = counts_[placed.cell].fetch_add(1, std::memory_order_relaxed);
      const GridCell& cell = grid.cells[placed.cell];
      write(list_of(grid, cell), cell.count, before, placed.entry);
    }
    placed_[task] = {};
  });
  parallel_ranges(grid.cells.size(), 4096, [&](std::size_t first, std::size_t last) {
    std::vector<CellEntry> entries;
    for (std::size_t i = first; i < last; ++i)
      if (grid.cells[i].count > 1) sort(list_of(grid, grid.cells[i]), grid.cells[i].count, entries);
  });
}

}  // namespace pah
