#include "report/study/work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel_for.hpp"
#include "geometry/ray_triangle.hpp"

namespace pah {
namespace {

// Computed in double, like the measures of boxes. Boxes are closed.
bool meets(const BundleRay& ray, const Aabb& box) {
  double near = ray.near;
  double far = ray.far;
  for (int k = 0; k < 3; ++k) {
    const double low = double{box.min[k]} - ray.origin[k];
    const double high = double{box.max[k]} - ray.origin[k];
    const double d = ray.direction[k];
    if (d == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / d;
    const double b = high / d;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

double cost_of(const BinaryTree::Node& node, std::uint32_t side_by_side) {
  return node.leaf() ? double{leaf_cost(node.count, side_by_side)} : 2 * double{box_cost};
}

Tally one_ray(double cost, bool hit) { return {1, 1, hit ? 1U : 0U, cost, cost * cost}; }
constexpr Tally a_miss{1, 0, 0, 0, 0};

Tally count_all(const StudyTree& on, const BundleRay& ray) {
  const std::vector<BinaryTree::Node>& nodes = on.tree.nodes;
  if (!meets(ray, nodes.front().box)) return a_miss;
  std::array<std::uint32_t, max_depth + 1> stack{};
  std::size_t size = 1;  // the root
  double cost = 0;
  while (size > 0) {
    const BinaryTree::Node& node = nodes[stack[--size]];
    cost += cost_of(node, on.side_by_side);
    if (node.leaf()) continue;
    for (const std::uint32_t child : {node.first, node.first + 1})
      if (meets(ray, nodes[child].box)) stack[size++] = child;
  }
  return one_ray(cost, false);
}

Tally count_closest(const StudyTree& on, const BundleRay& bundle_ray, bool within_region) {
  Ray from = ray_of(bundle_ray);
  if (!within_region) from.t_max = std::numeric_limits<float>::infinity();
  const PreparedRay ray = prepare(from);
  const std::vector<BinaryTree::Node>& nodes = on.tree.nodes;
  struct Entry {
    std::uint32_t node;
    SlabInterval interval;
  };
  const auto entry_of = [&](std::uint32_t node) {
    return Entry{node, intersect_box(ray, nodes[node].box)};
  };
  Hit best;
  best.t = ray.t_max;
  const auto open = [&](const Entry& entry) {
    return entry.interval.near <= std::min(entry.interval.far, best.t);
  };
  std::array<Entry, max_depth + 2> stack;
  stack[0] = entry_of(0);
  if (!open(stack[0])) return a_miss;
  std::size_t size = 1;
  double cost = 0;
  while (size > 0) {
    const Entry entry = stack[--size];
    if (!open(entry)) continue;
    const BinaryTree::Node& node = nodes[entry.node];
    cost += cost_of(node, on.side_by_side);
    if (node.leaf()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t triangle = on.subset[on.tree.order[i]];
        update_nearest(ray, on.triangles[triangle], triangle, best);
      }
      continue;
    }
    Entry nearer = entry_of(node.first);
    Entry farther = entry_of(node.first + 1);
    if (farther.interval.near < nearer.interval.near) std::swap(nearer, farther);
    if (open(farther)) stack[size++] = farther;
    if (open(nearer)) stack[size++] = nearer;
  }
  return one_ray(cost, best.valid());
}

template <typename Count>
Tally sum_over(std::span<const BundleRay> rays, const Count& count) {
  const auto part = [&](std::size_t first, std::size_t last) {
    Tally tally;
    for (std::size_t i = first; i < last; ++i) tally.add(count(rays[i]));
    return tally;
  };
  return parallel_fold(rays.size(), 1024, Tally{}, part,
                       [](Tally& sum, const Tally& other) { sum.add(other); });
}

}  // namespace

void Tally::add(const Tally& other) {
  rays += other.rays;
  met += other.met;
  hits += other.hits;
  cost += other.cost;
  cost_squared += other.cost_squared;
}

double Tally::mean() const { return met > 0 ? cost / static_cast<double>(met) : 0; }

double Tally::standard_error() const {
  if (met < 2) return 0;
  const auto n = static_cast<double>(met);
  const double variance = std::max(0.0, (cost_squared - cost * cost / n) / (n - 1));
  return std::sqrt(variance / n);
}

double Tally::mean_of_all() const { return rays > 0 ? cost / static_cast<double>(rays) : 0; }

double Tally::hit_share() const {
  return rays > 0 ? static_cast<double>(hits) / static_cast<double>(rays) : 0;
}

Tally count_all(const StudyTree& tree, std::span<const BundleRay> rays) {
  if (tree.tree.empty()) return {rays.size(), 0, 0, 0, 0};
  return sum_over(rays, [&](const BundleRay& ray) { return count_all(tree, ray); });
}

Tally count_closest(const StudyTree& tree, std::span<const BundleRay> rays, bool within_region) {
  if (tree.tree.empty()) return {rays.size(), 0, 0, 0, 0};
  return sum_over(rays,
                  [&](const BundleRay& ray) { return count_closest(tree, ray, within_region); });
}

double kernel_cost(const Bvh& bvh, std::span<const BundleRay> rays, std::uint32_t side_by_side) {
  std::vector<Ray> asked(rays.size());
  std::ranges::transform(rays, asked.begin(), ray_of);
  std::vector<Hit> hits(rays.size());
  TraversalCounts counts;
  closest_hits(bvh, asked, hits, &counts);
  return (double{box_cost} * static_cast<double>(counts.nodes) +
          double{triangle_cost} * static_cast<double>(counts.triangles) / side_by_side) /
         static_cast<double>(std::max<std::size_t>(rays.size(), 1));
}

}  // namespace pah
