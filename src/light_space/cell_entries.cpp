#include "light_space/cell_entries.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "parallel/parallel_for.hpp"

namespace pah {

namespace {

void write_list(std::span<CellEntry> entries, std::uint32_t* words) {
  std::ranges::sort(entries, {}, [](const CellEntry& e) { return std::pair(e.nearest, e.block); });
  const std::size_t count = entries.size();
  for (std::size_t k = 0; k < count; ++k) {
    words[k] = std::bit_cast<std::uint32_t>(entries[k].nearest);
    words[count + k] = entries[k].places;
    words[2 * count + k] = entries[k].block;
  }
}

}  // namespace

void CellEntries::sort_into(LightGrid& grid) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    grid.cells[i] = {sum, 0};
    sum += counts_[i].exchange(0, std::memory_order_relaxed);
  }
  std::vector<CellEntry> entries(sum);
  parallel_for(placed_.size(), 1, [&](std::size_t task) {
    for (const Placed& placed : placed_[task]) {
      const std::uint32_t before = counts_[placed.cell].fetch_add(1, std::memory_order_relaxed);
      entries[grid.cells[placed.cell].first + before] = placed.entry;
    }
    placed_[task] = {};
  });
  grid.lists.resize(std::size_t{3} * sum + LightGrid::read_beyond);
  parallel_for(grid.cells.size(), 4096, [&](std::size_t i) {
    GridCell& cell = grid.cells[i];
    cell.count = counts_[i].load(std::memory_order_relaxed);
    if (cell.count > 0)
      write_list(std::span(entries).subspan(cell.first, cell.count),
                 &grid.lists[std::size_t{3} * cell.first]);
  });
}

}  // namespace pah
