#include <algorithm>
#include <array>
#include <chrono>
#include <pah/accel/light_grids.hpp>

#include "bvh/build.hpp"
#include "light_space/light_grid.hpp"

namespace pah {

namespace {

class LightGridsOverBvh final : public LightGrids {
 public:
  LightGridsOverBvh(const Triangles& triangles, const std::vector<LightBundle>& bundles)
      : bvh_(build_bvh(triangles).bvh) {
    using Clock = std::chrono::steady_clock;
    grids_.reserve(bundles.size());
    for (const LightBundle& bundle : bundles) {
      const auto start = Clock::now();
      grids_.push_back({bundle.bundle, LightGrid(bvh_, bundle.rays)});
      reports_.push_back({grids_.back().grid.memory_bytes(),
                          std::chrono::duration<double>(Clock::now() - start).count()});
    }
    std::ranges::sort(grids_, {}, &BundleGrid::bundle);
  }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    closest_hits(bvh_, rays, hits, counts);
  }

  // Runs of rays of one bundle at a time.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    std::size_t first = 0;
    while (first < rays.size()) {
      const std::uint32_t bundle = rays[first].bundle;
      std::size_t last = first + 1;
      while (last < rays.size() && rays[last].bundle == bundle) ++last;
      const auto run = rays.subspan(first, last - first);
      const auto answers = results.subspan(first, last - first);
      const auto grid = std::ranges::lower_bound(grids_, bundle, {}, &BundleGrid::bundle);
      if (grid != grids_.end() && grid->bundle == bundle) {
        look_up(grid->grid, run, answers, counts);
      } else {
        pah::occluded(bvh_, run, answers, counts);
      }
      first = last;
    }
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    AcceleratorMemory memory{.global_bvh = bvh_.memory_bytes()};
    for (const LightGridReport& report : reports_) memory.light_grids += report.bytes;
    memory.top_level = grids_.capacity() * sizeof(BundleGrid);
    return memory;
  }

  [[nodiscard]] const std::vector<LightGridReport>& reports() const override { return reports_; }

 private:
  struct BundleGrid {
    std::uint32_t bundle;
    LightGrid grid;
  };

  // What the grid does not answer traverses.
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
  std::vector<BundleGrid> grids_;
  std::vector<LightGridReport> reports_;
};

}  // namespace

std::unique_ptr<LightGrids> make_light_grids(Triangles triangles,
                                             const std::vector<LightBundle>& bundles) {
  return std::make_unique<LightGridsOverBvh>(triangles, bundles);
}

}  // namespace pah
