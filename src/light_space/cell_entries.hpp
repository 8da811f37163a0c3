// Collects the entries of a light grid's cells while it is built, then sorts them into its lists.
#pragma once

#include <atomic>

#include "light_space/light_grid.hpp"

namespace pah {

// One block of triangles in one cell.
struct CellEntry {
  float nearest;
  PlaceBytes places;
  std::uint32_t block;
};

// Each task appends to its own list; all tasks share the cells' counters.
class CellEntries {
 public:
  CellEntries(std::size_t tasks, std::size_t cells) : placed_(tasks), counts_(cells) {}

  struct Placed {
    std::uint32_t cell;
    CellEntry entry;
  };
  [[nodiscard]] std::vector<Placed>& of_task(std::size_t task) { return placed_[task]; }
  void count(std::uint32_t cell) { counts_[cell].fetch_add(1, std::memory_order_relaxed); }

  // Fills the grid's cells and lists, and frees the entries.
  void sort_into(LightGrid& grid);

 private:
  std::vector<std::vector<Placed>> placed_;
  std::vector<std::atomic<std::uint32_t>> counts_;
};

}  // namespace pah
