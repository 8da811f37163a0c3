#include "rays/sorted_rays.hpp"

#include <algorithm>
#include <numeric>
#include <pah/geometry/aabb.hpp>

namespace pah::bench {
namespace {

constexpr std::uint32_t cells_along = 16;  // an axis
constexpr std::uint32_t cells = cells_along * cells_along * cells_along;

// Four bits, two apart.
std::uint32_t spread(std::uint32_t x) {
  return (x & 1U) | (x & 2U) << 2U | (x & 4U) << 4U | (x & 8U) << 6U;
}

std::uint32_t morton_cell(const Vec3& at) {
  const UVec3 cell = glm::min(UVec3(at), UVec3(cells_along - 1));
  return spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
}

class SortedRays final : public Accelerator {
 public:
  explicit SortedRays(std::unique_ptr<Accelerator> accelerator)
      : accelerator_(std::move(accelerator)) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    accelerator_->closest_hit(rays, hits, counts);
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    sort(rays);
    sorted_results_.resize(rays.size());
    accelerator_->occluded(sorted_, sorted_results_, counts);
    for (std::size_t i = 0; i < rays.size(); ++i) results[i] = sorted_results_[places_[i]];
  }

  [[nodiscard]] AcceleratorMemory memory() const override { return accelerator_->memory(); }

 private:
  // By counting, in time that grows with the rays only.
  void sort(std::span<const Ray> rays) const {
    Aabb box;
    for (const Ray& ray : rays) box.extend(ray.origin);
    const Vec3 per_length = float(cells_along) / glm::max(box.max - box.min, Vec3(1e-20F));
    std::ranges::fill(ends_, 0);
    places_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      places_[i] = morton_cell((rays[i].origin - box.min) * per_length);
      ++ends_[places_[i]];
    }
    std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0U);
    sorted_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      places_[i] = ends_[places_[i]]++;
      sorted_[places_[i]] = rays[i];
    }
  }

  std::unique_ptr<Accelerator> accelerator_;
  mutable std::vector<std::uint32_t> ends_ = std::vector<std::uint32_t>(cells);  // of cells
  mutable std::vector<std::uint32_t> places_;  // of rays, at first their cells
  mutable std::vector<Ray> sorted_;
  mutable std::vector<std::uint8_t> sorted_results_;
};

}  // namespace

std::unique_ptr<Accelerator> make_sorted(std::unique_ptr<Accelerator> accelerator) {
  return std::make_unique<SortedRays>(std::move(accelerator));
}

}  // namespace pah::bench
