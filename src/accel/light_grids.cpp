#include <algorithm>
#include <array>
#include <pah/accel/light_grids.hpp>

#include "base/stopwatch.hpp"
#include "bvh/build.hpp"
#include "light_space/light_grid.hpp"

namespace pah {

namespace {

GridLists lists_of(const LightGrid& grid) {
  GridLists lists;
  lists.cells = grid.cells.size();
  for (const GridCell& cell : grid.cells) {
    if (cell.count == GridCell::unknown) continue;
    lists.empty_cells += cell.count == 0 ? 1 : 0;
    lists.entries += cell.count;
    lists.longest_list = std::max<std::uint64_t>(lists.longest_list, cell.count);
  }
  return lists;
}

class LightGridsOverBvh final : public LightGrids {
 public:
  explicit LightGridsOverBvh(const Triangles& triangles) {
    const Stopwatch stopwatch;
    bvh_ = build_bvh(triangles).bvh;
    bvh_build_seconds_ = stopwatch.seconds();
  }

  void add(const LightBundle& bundle) override {
    const Stopwatch stopwatch;
    auto grid = std::make_unique<LightGrid>(bvh_, bundle.rays);
    const LightGridReport report{bundle.bundle, grid->memory_bytes(), stopwatch.seconds(),
                                 lists_of(*grid)};
    grids_.insert(place_of(bundle.bundle), {report, std::move(grid)});
  }
  void remove(std::uint32_t bundle) override {
    std::erase_if(grids_, [=](const BundleGrid& grid) { return grid.report.bundle == bundle; });
    grids_.shrink_to_fit();
  }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    closest_hits(bvh_, rays, hits, counts);
  }

  // Handles consecutive rays of one bundle at a time.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    std::size_t first = 0;
    while (first < rays.size()) {
      const std::uint32_t bundle = rays[first].bundle;
      std::size_t last = first + 1;
      while (last < rays.size() && rays[last].bundle == bundle) ++last;
      const auto run = rays.subspan(first, last - first);
      const auto answers = results.subspan(first, last - first);
      const auto grid = place_of(bundle);
      if (grid != grids_.end() && grid->report.bundle == bundle) {
        look_up(*grid->grid, run, answers, counts);
      } else {
        pah::occluded(bvh_, run, answers, counts);
      }
      first = last;
    }
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    AcceleratorMemory memory{.global_bvh = bvh_.memory_bytes()};
    for (const BundleGrid& grid : grids_) memory.light_grids += grid.report.bytes;
    memory.top_level = grids_.capacity() * sizeof(BundleGrid);
    return memory;
  }

  [[nodiscard]] std::vector<LightGridReport> reports() const override {
    std::vector<LightGridReport> reports;
    reports.reserve(grids_.size());
    for (const BundleGrid& grid : grids_) reports.push_back(grid.report);
    return reports;
  }
  [[nodiscard]] double bvh_build_seconds() const override { return bvh_build_seconds_; }

 private:
  struct BundleGrid {
    LightGridReport report;
    std::unique_ptr<LightGrid> grid;
  };

  // The position of the bundle's grid, or where to insert it.
  [[nodiscard]] std::vector<BundleGrid>::const_iterator place_of(std::uint32_t bundle) const {
    return std::ranges::lower_bound(grids_, bundle, {},
                                    [](const BundleGrid& grid) { return grid.report.bundle; });
  }

  // Rays that the grid does not answer traverse the BVH.
  void look_up(const LightGrid& grid, std::span<const Ray> rays, std::span<std::uint8_t> results,
               TraversalCounts* counts) const {
    constexpr std::size_t batch_size = 256;
    std::array<LightGrid::Answer, batch_size> answers;
    for (std::size_t first = 0; first < rays.size(); first += batch_size) {
      const std::size_t size = std::min(batch_size, rays.size() - first);
      grid.occluded(rays.subspan(first, size), std::span(answers).first(size), counts);
      for (std::size_t i = 0; i < size; ++i) {
        if (answers[i] == LightGrid::Answer::unknown) {
          pah::occluded(bvh_, rays.subspan(first + i, 1), results.subspan(first + i, 1), counts);
        } else {
          results[first + i] = answers[i] == LightGrid::Answer::occluded ? 1 : 0;
        }
      }
    }
  }

  Bvh bvh_;
  double bvh_build_seconds_ = 0;
  std::vector<BundleGrid> grids_;  // by bundle
};

}  // namespace

std::unique_ptr<LightGrids> make_light_grids(Triangles triangles,
                                             const std::vector<LightBundle>& bundles) {
  auto grids = std::make_unique<LightGridsOverBvh>(triangles);
  for (const LightBundle& bundle : bundles) grids->add(bundle);
  return grids;
}

}  // namespace pah
