// Assigns each ray to a local BVH or to the global BVH.
//
// A local BVH holds every triangle whose box, widened by a margin, meets the area's region. The
// ray's point at the t of a hit lies within rounding errors of the triangle (ray_triangle.hpp). So
// as long as the ray stays in the region, or within a fraction of the margin of it, every hit is a
// hit of the local BVH: up to that t its answer, the nearest hit or none, is final. This holds for
// triangles that the region cuts, for areas that overlap and for eyes inside of boxes. A ray
// without a hit up to that t is traced through the global BVH from its start.
#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <pah/accel/local_bvhs.hpp>
#include <utility>
#include <variant>

#include "accel/local/build_local.hpp"
#include "accel/local/top_level.hpp"
#include "base/mix_bits.hpp"
#include "geometry/ray_box.hpp"

namespace pah {

namespace {

struct BuiltArea {
  LocalArea declared;
  Region region;
  float end_margin = 0;
  bool holds_scene = false;  // every triangle is in the local BVH
  Bvh bvh;

  // The t up to which the local BVH's answer is final; nothing if the ray starts outside.
  [[nodiscard]] std::optional<float> reach(const Ray& ray, const Aabb& scene) const {
    if (!contains(region, ray.origin)) return {};
    return reach_from_inside(ray, scene);
  }
  [[nodiscard]] float reach_from_inside(const Ray& ray, const Aabb& scene) const {
    constexpr float everywhere = std::numeric_limits<float>::infinity();
    if (holds_scene || ends_at_eye(ray)) return everywhere;
    const float exit = exit_distance(region, ray);
    return intersect_box(prepare(ray), scene).far <= exit ? everywhere : exit;
  }

 private:
  // A segment between two points of a convex region lies in the region. t_max may end it short of
  // the eye by more than the margin: what counts is the point at t = 1.
  [[nodiscard]] bool ends_at_eye(const Ray& ray) const {
    const auto* point = std::get_if<PointArea>(&declared.area);
    if (point == nullptr || point->frustum.near > 0 || !(ray.t_max <= 1)) return false;
    const DVec3 end = DVec3(ray.origin) + DVec3(ray.direction);
    return glm::all(
        glm::lessThanEqual(glm::abs(end - point->frustum.eye), DVec3(double{end_margin})));
  }
};

// Threads add their batch's counters. The totals are read only after all threads have finished.
struct Counters {
  struct Work {
    std::atomic<std::uint64_t> rays = 0, inner_nodes = 0, blocks = 0;

    void add(std::uint64_t more, const TraversalCounts& spent) {
      rays.fetch_add(more, std::memory_order_relaxed);
      inner_nodes.fetch_add(spent.inner_nodes, std::memory_order_relaxed);
      blocks.fetch_add(spent.blocks, std::memory_order_relaxed);
    }
    [[nodiscard]] double cost() const {
      return traversal_cost({.inner_nodes = inner_nodes, .blocks = blocks});
    }
  };
  Work local, global;
  std::atomic<std::uint64_t> answered = 0;
};

// Whether a ray is in the sample that is also traced through the global BVH to measure its cost
// there. The ray's own bits decide, so that the sample depends neither on batches nor on threads.
bool is_sampled(const Ray& ray) {
  constexpr std::uint64_t one_in = 64;
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint64_t origin = std::bit_cast<std::uint32_t>(ray.origin[axis]);
    const std::uint64_t direction = std::bit_cast<std::uint32_t>(ray.direction[axis]);
    hash = mix_bits(hash ^ (origin << 32U | direction));
  }
  return hash % one_in == 0;
}

constexpr std::size_t batch_size = 64;

// Calls `trace(batch, first)` for successive runs of `rays`.
template <typename Trace>
void for_batches(std::span<const Ray> rays, const Trace& trace) {
  for (std::size_t first = 0; first < rays.size(); first += batch_size)
    trace(rays.subspan(first, std::min(batch_size, rays.size() - first)), first);
}

class LocalBvhsOverGlobal final : public LocalBvhs {
 public:
  LocalBvhsOverGlobal(const Triangles& triangles, const std::vector<LocalArea>& areas,
                      const LocalConfig& config)
      : bounds_(padded(bounds_of(triangles))),
        global_(build_bvh(triangles).bvh),
        counters_(areas.size()) {
    areas_.reserve(areas.size());
    for (const LocalArea& area : areas) add(area, triangles, config);
    order_.resize(areas_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    const auto cost = [&](std::uint32_t i) { return reports_[i].predicted_cost; };
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return std::pair(cost(i), i); });
    top_level_ = make_top_level(config.top_level);
    direction_tolerance_ = config.top_level.direction_tolerance;
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t i) { return bundle_of(i); });
  }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    for_batches(rays, [&](std::span<const Ray> batch, std::size_t first) {
      const std::span<Hit> found = hits.subspan(first, batch.size());
      const auto trace = [&](const Bvh& bvh, const Lanes& lanes, TraversalCounts* spent) {
        std::array<Hit, batch_size> local;
        closest_hits(bvh, lanes.span(), std::span(local.data(), lanes.count), spent);
        for (std::size_t k = 0; k < lanes.count; ++k) found[lanes.index[k]] = local[k];
        return [found](std::size_t i) { return found[i].valid(); };
      };
      answer(batch, counts, trace);
    });
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    for_batches(rays, [&](std::span<const Ray> batch, std::size_t first) {
      const std::span<std::uint8_t> found = results.subspan(first, batch.size());
      const auto trace = [&](const Bvh& bvh, const Lanes& lanes, TraversalCounts* spent) {
        std::array<std::uint8_t, batch_size> local;
        pah::occluded(bvh, lanes.span(), std::span(local.data(), lanes.count), spent);
        for (std::size_t k = 0; k < lanes.count; ++k) found[lanes.index[k]] = local[k];
        return [found](std::size_t i) { return found[i] != 0; };
      };
      answer(batch, counts, trace);
    });
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    AcceleratorMemory memory{.global_bvh = global_.memory_bytes()};
    for (const LocalBvhReport& report : reports_) memory.local_bvhs += report.bytes;
    memory.top_level =
        areas_.capacity() * sizeof(BuiltArea) + order_.capacity() * sizeof(order_[0]);
    if (const auto* list = std::get_if<AreaList>(&top_level_))
      memory.top_level += list->memory_bytes();
    if (const auto* octree = std::get_if<AreaOctree>(&top_level_))
      memory.top_level += octree->memory_bytes();
    return memory;
  }

  [[nodiscard]] const std::vector<LocalBvhReport>& reports() const override { return reports_; }

  [[nodiscard]] std::optional<std::size_t> area_of(const Ray& ray) const override {
    const Assignment assigned = assign(ray);
    return assigned.area == the_global_bvh ? std::nullopt
                                           : std::optional<std::size_t>(assigned.area);
  }

  [[nodiscard]] std::vector<LocalBvhUse> uses() const override {
    std::vector<LocalBvhUse> uses;
    uses.reserve(counters_.size());
    for (const Counters& c : counters_) {
      uses.push_back({.asked = c.local.rays,
                      .answered = c.answered,
                      .cost = c.local.cost(),
                      .sampled = c.global.rays,
                      .global_cost = c.global.cost()});
    }
    return uses;
  }

 private:
  static constexpr std::uint32_t the_global_bvh = 0xFFFFFFFFU;

  // A subset of a batch's rays, contiguous.
  struct Lanes {
    std::array<Ray, batch_size> rays;
    std::array<std::size_t, batch_size> index;  // in the batch
    std::size_t count = 0;

    void add(const Ray& ray, std::size_t i) {
      rays[count] = ray;
      index[count++] = i;
    }
    [[nodiscard]] std::span<const Ray> span() const { return {rays.data(), count}; }
  };

  struct Assignment {
    std::uint32_t area = the_global_bvh;
    float reach = std::numeric_limits<float>::infinity();
  };

  [[nodiscard]] std::uint32_t bundle_of(std::uint32_t area) const {
    return areas_[area].declared.bundle;
  }

  void add(const LocalArea& declared, const Triangles& triangles, const LocalConfig& config) {
    BuiltArea area;
    area.declared = declared;
    BuiltLocalBvh local = build_local_bvh(triangles, declared.area, config);
    area.region = local.triangles.region;
    area.end_margin = local.triangles.end_margin;
    area.holds_scene = local.triangles.subset.size() == triangles.size();

    LocalBvhReport report;
    report.triangles = local.triangles.subset.size();
    report.bytes = local.built.bvh.memory_bytes();
    report.build_seconds = local.seconds;
    report.predicted_cost = bundle_cost(local.built.bvh, declared.area);
    report.global_cost = bundle_cost(global_, declared.area);
    reports_.push_back(report);
    area.bvh = std::move(local.built.bvh);
    areas_.push_back(std::move(area));
  }

  // Lists the areas in the order of their costs.
  [[nodiscard]] TopLevel make_top_level(const TopLevelConfig& config) const {
    if (config.kind == TopLevelKind::none || areas_.empty()) return {};
    std::vector<Region> regions;
    regions.reserve(areas_.size());
    for (const BuiltArea& area : areas_) regions.push_back(area.region);
    if (config.kind == TopLevelKind::list) return AreaList(regions, order_);
    return AreaOctree(regions, order_, config.octree_depth);
  }

  [[nodiscard]] Assignment assign(const Ray& ray) const {
    if (ray.bundle != no_bundle) {
      const Assignment by_bundle = assign_by_bundle(ray);
      if (by_bundle.area != the_global_bvh) return by_bundle;
    }
    return std::visit([&](const auto& top_level) { return assign_by(top_level, ray); }, top_level_);
  }

  [[nodiscard]] static Assignment assign_by(const std::monostate& /*none*/, const Ray& /*ray*/) {
    return {};
  }
  // A cell may extend beyond its areas: the origin is tested against the area itself.
  [[nodiscard]] Assignment assign_by(const auto& top_level, const Ray& ray) const {
    Assignment assigned;
    top_level.visit(ray.origin, [&](const AreaCandidate& candidate) {
      const BuiltArea& area = areas_[candidate.area];
      if (!candidate.certain && !contains(area.region, ray.origin)) return false;
      if (!is_affine(area.declared.area, ray, direction_tolerance_)) return false;
      assigned = {candidate.area, area.reach_from_inside(ray, bounds_)};
      return true;
    });
    return assigned;
  }

  [[nodiscard]] Assignment assign_by_bundle(const Ray& ray) const {
    const auto first = std::lower_bound(
        order_.begin(), order_.end(), ray.bundle,
        [&](std::uint32_t i, std::uint32_t bundle) { return bundle_of(i) < bundle; });
    for (auto i = first; i != order_.end() && bundle_of(*i) == ray.bundle; ++i) {
      if (const auto reach = areas_[*i].reach(ray, bounds_)) return {*i, *reach};
    }
    return {};
  }

  // Calls `trace(bvh, lanes, counts)` for the rays of each area, then with the global BVH for those
  // without a final answer. `trace` returns a function that tells whether ray i of the batch has
  // hit something.
  template <typename Trace>
  void answer(std::span<const Ray> batch, TraversalCounts* counts, const Trace& trace) const {
    std::array<Assignment, batch_size> assigned;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      assigned[i] = assign(batch[i]);
    }
    Lanes open;
    std::array<bool, batch_size> done{};
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (done[i]) continue;
      const std::uint32_t area = assigned[i].area;
      if (area == the_global_bvh) {
        open.add(batch[i], i);
        continue;
      }
      Lanes lanes;
      for (std::size_t k = i; k < batch.size(); ++k) {
        if (assigned[k].area != area) continue;
        lanes.add(batch[k], k);
        lanes.rays[lanes.count - 1].t_max = std::min(batch[k].t_max, assigned[k].reach);
        done[k] = true;
      }
      if (counts != nullptr) sample(lanes, batch, area, trace);
      TraversalCounts spent;
      const auto hit = trace(areas_[area].bvh, lanes, counts == nullptr ? nullptr : &spent);
      const std::size_t open_before = open.count;
      for (std::size_t k = 0; k < lanes.count; ++k) {
        const std::size_t ray = lanes.index[k];
        if (assigned[ray].reach < batch[ray].t_max && !hit(ray)) open.add(batch[ray], ray);
      }
      if (counts != nullptr) {
        counters_[area].local.add(lanes.count, spent);
        counters_[area].answered.fetch_add(lanes.count - (open.count - open_before),
                                           std::memory_order_relaxed);
        *counts += spent;
      }
    }
    if (open.count > 0) trace(global_, open, counts);
  }

  // Traces a sample of the rays through the global BVH. The answers that this writes are
  // overwritten by the area's trace.
  template <typename Trace>
  void sample(const Lanes& lanes, std::span<const Ray> batch, std::uint32_t area,
              const Trace& trace) const {
    Lanes sampled;
    for (const std::size_t i : std::span(lanes.index).first(lanes.count)) {
      if (is_sampled(batch[i])) sampled.add(batch[i], i);
    }
    if (sampled.count == 0) return;
    TraversalCounts spent;
    trace(global_, sampled, &spent);
    counters_[area].global.add(sampled.count, spent);
  }

  Aabb bounds_;  // of all triangles, padded
  Bvh global_;
  std::vector<BuiltArea> areas_;
  std::vector<std::uint32_t> order_;  // areas by bundle, then by cost
  TopLevel top_level_;
  double direction_tolerance_ = 0;
  std::vector<LocalBvhReport> reports_;
  mutable std::vector<Counters> counters_;
};

}  // namespace

std::unique_ptr<LocalBvhs> make_local_bvhs(Triangles triangles, const std::vector<LocalArea>& areas,
                                           const LocalConfig& config) {
  return std::make_unique<LocalBvhsOverGlobal>(triangles, areas, config);
}

}  // namespace pah
