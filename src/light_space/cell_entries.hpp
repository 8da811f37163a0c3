// What is in which cell of a light's grid, until all of it is known and sorted.
#pragma once

#include <atomic>

#include "light_space/light_grid.hpp"

namespace pah {

// A block in a cell.
struct CellEntry {
  float nearest;
  PlaceBytes places;
  std::uint32_t block;
};

// Filled in by tasks, each its own list; the cells' counts are shared.
class CellEntries {
 public:
  CellEntries(std::size_t tasks, std::size_t cells) : placed_(tasks), counts_(cells) {}

  struct Placed {
    std::uint32_t cell;
    CellEntry entry;
  };
  [[nodiscard]] std::vector<Placed>& of_task(std::size_t task) { return placed_[task]; }
  void count(std::uint32_t cell) { counts_[cell].fetch_add(1, std::memory_order_relaxed); }

  // The cells and lists of the grid; entries are gone then.
  void sort_into(LightGrid& grid);

 private:
  std::vector<std::vector<Placed>> placed_;
  std::vector<std::atomic<std::uint32_t>> counts_;
};

}  // namespace pah
