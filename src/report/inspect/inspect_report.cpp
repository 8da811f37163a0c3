#include "report/inspect/inspect_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pah/accel/trees.hpp>

#include "base/format_bytes.hpp"
#include "report/json.hpp"

namespace pah {
namespace {

double hit_share(const CostSummary& rays) {
  return rays.rays == 0 ? 0 : static_cast<double>(rays.hits) / static_cast<double>(rays.rays);
}

std::string leaf_sizes_text(const TreeSummary& tree) {
  constexpr std::uint64_t bar_width = 40;
  std::uint64_t most = 1;
  for (const std::uint64_t leaves : tree.leaf_sizes) most = std::max(most, leaves);
  std::string text = "  triangles     leaves\n";
  for (std::size_t size = 1; size < tree.leaf_sizes.size(); ++size) {
    const std::uint64_t leaves = tree.leaf_sizes[size];
    const std::string bar((leaves * bar_width + most - 1) / most, '#');
    text += fmt::format("  {:9} {:10}{}{}\n", size, leaves, bar.empty() ? "" : "  ", bar);
  }
  return text;
}

std::string levels_text(const TreeSummary& tree, const std::optional<SeenOverlap>& seen) {
  std::string text = fmt::format("  level      nodes     leaves  overlap of siblings{}\n",
                                 seen ? "  for area rays" : "");
  for (std::size_t depth = 0; depth < tree.levels.size(); ++depth) {
    const TreeLevel& level = tree.levels[depth];
    text += fmt::format("  {:5} {:10} {:10}", depth, level.nodes, level.leaves);
    if (level.nodes > level.leaves) text += fmt::format("  {:5.1f} %", 100 * level.overlap);
    if (seen && level.nodes > level.leaves)
      text += fmt::format("  {:23.1f} %", 100 * seen->levels[depth]);
    text += '\n';
  }
  return text;
}

std::string bvh_text(const BvhReport& bvh) {
  const TreeSummary& tree = bvh.tree;
  std::string text = fmt::format("\nBVH {} ({})\n", bvh.name, bvh.heuristic);
  const auto line = [&](std::string_view name, const std::string& value) {
    text += fmt::format("  {:18}{}\n", name, value);
  };
  line("triangles", fmt::format("{}", tree.triangles));
  line("binary nodes", fmt::format("{}, of which {} are leaves", tree.nodes, tree.leaves));
  line("eight-wide nodes", fmt::format("{}", bvh.wide_nodes));
  line("depth of leaves", fmt::format("mean {:.1f}, at most {}", tree.mean_depth, tree.max_depth));
  if (tree.balance.nodes > 0)
    line("balance",
         fmt::format(
             "smaller child: {:.0f} % of the triangles on average; below {:g} % in {:.1f} % of "
             "the large nodes",
             100 * tree.balance.smaller_share, 100 * TreeBalance::lopsided_below,
             100 * tree.balance.lopsided));
  line("expected cost",
       bvh.bundle ? fmt::format("{:.2f} for the area's rays that meet the root, {:.2f} by SAH",
                                bvh.expected_cost, bvh.surface_cost)
                  : fmt::format("{:.2f}", bvh.expected_cost));
  line("sibling overlap", fmt::format("{:.1f} % of the parent on average", 100 * tree.overlap));
  if (bvh.seen)
    line("  for area rays",
         fmt::format("{:.1f} % of the parent on average, as the rays see it", 100 * bvh.seen->all));
  if (const auto& bundle = bvh.bundle)
    line("area rays", fmt::format("expected cost {:.2f}, in the global BVH {:.2f}", bundle->local,
                                  bundle->global));
  if (const auto& rays = bvh.area_rays) {
    line("measured rays",
         fmt::format("{}, of which {} do not need the global BVH", rays->rays, rays->answered));
    if (rays->rays > 0)
      line("  cost",
           fmt::format("mean {:.2f}, in the global BVH alone {:.2f}", rays->local, rays->global));
  }
  if (const auto& rays = bvh.camera_rays) {
    line("camera rays",
         fmt::format("{}, of which {:.1f} % hit", rays->rays, 100 * hit_share(*rays)));
    line("  node visits",
         fmt::format("mean {:.2f}, at most {}", rays->nodes_per_ray, rays->max_nodes));
    line("  triangle tests",
         fmt::format("mean {:.2f}, at most {}", rays->triangles_per_ray, rays->max_triangles));
  }
  line("memory", format_bytes(bvh.memory_bytes));
  line("build", fmt::format("{:.3g} s", bvh.build_seconds));
  if (tree.nodes > 0) text += "\n" + leaf_sizes_text(tree) + "\n" + levels_text(tree, bvh.seen);
  return text;
}

OrderedJson bvh_json(const BvhReport& bvh) {
  const TreeSummary& tree = bvh.tree;
  OrderedJson sizes = OrderedJson::array();
  for (std::size_t size = 1; size < tree.leaf_sizes.size(); ++size)
    sizes.push_back({{"triangles", size}, {"leaves", tree.leaf_sizes[size]}});
  OrderedJson levels = OrderedJson::array();
  for (std::size_t depth = 0; depth < tree.levels.size(); ++depth) {
    const TreeLevel& level = tree.levels[depth];
    OrderedJson json{{"nodes", level.nodes}, {"leaves", level.leaves}, {"overlap", level.overlap}};
    if (bvh.seen) json["seen_overlap"] = bvh.seen->levels[depth];
    levels.push_back(std::move(json));
  }
  OrderedJson json{{"name", bvh.name},
                   {"heuristic", bvh.heuristic},
                   {"triangles", tree.triangles},
                   {"nodes", tree.nodes},
                   {"leaves", tree.leaves},
                   {"wide_nodes", bvh.wide_nodes},
                   {"depth", {{"max", tree.max_depth}, {"mean", tree.mean_depth}}},
                   {"balance",
                    {{"smaller_share", tree.balance.smaller_share},
                     {"smallest_share", tree.balance.smallest_share},
                     {"lopsided", tree.balance.lopsided}}},
                   {"expected_cost", bvh.expected_cost},
                   {"surface_cost", bvh.surface_cost},
                   {"overlap", tree.overlap},
                   {"memory_bytes", bvh.memory_bytes},
                   {"build_seconds", bvh.build_seconds},
                   {"leaf_sizes", std::move(sizes)},
                   {"levels", std::move(levels)}};
  if (bvh.seen) json["seen_overlap"] = bvh.seen->all;
  if (const auto& bundle = bvh.bundle)
    json["bundle_cost"] = {{"local", bundle->local}, {"global", bundle->global}};
  if (const auto& rays = bvh.area_rays)
    json["measured_rays"] = {{"rays", rays->rays},
                             {"answered", rays->answered},
                             {"cost", rays->local},
                             {"global_cost", rays->global}};
  if (const auto& rays = bvh.camera_rays)
    json["camera_rays"] = {{"rays", rays->rays},
                           {"hits", rays->hits},
                           {"nodes_per_ray", rays->nodes_per_ray},
                           {"triangles_per_ray", rays->triangles_per_ray},
                           {"max_nodes", rays->max_nodes},
                           {"max_triangles", rays->max_triangles}};
  return json;
}

}  // namespace

SeenOverlap seen_overlaps(const BinaryTree& tree, const InfluenceArea& area) {
  SeenOverlap seen;
  std::vector<std::uint64_t> inner;
  const auto per_node = [&](const NodeVisit& visit) {
    if (visit.depth == seen.levels.size()) {
      seen.levels.push_back(0);
      inner.push_back(0);
    }
    if (visit.node().leaf()) return;
    seen.levels[visit.depth] +=
        seen_overlap(area, visit.node().box, visit.left().box, visit.right().box);
    ++inner[visit.depth];
  };
  return visit_tree(tree, per_node, [&] {
    std::uint64_t all = 0;
    for (std::size_t depth = 0; depth < inner.size(); ++depth) {
      all += inner[depth];
      seen.all += seen.levels[depth];
      if (inner[depth] > 0) seen.levels[depth] /= static_cast<double>(inner[depth]);
    }
    if (all > 0) seen.all /= static_cast<double>(all);
    return seen;
  });
}

std::string inspect_text(const InspectReport& report) {
  std::string text = fmt::format("{}: {} triangles, {} x {} pixels\n", report.scene,
                                 report.triangles, report.width, report.height);
  text += fmt::format("accelerator of a render: {}\n", report.accelerator);
  for (const BvhReport& bvh : report.bvhs) text += bvh_text(bvh);
  for (const GridReport& grid : report.light_grids) text += grid_text(grid);
  return text;
}

std::string inspect_json(const InspectReport& report) {
  OrderedJson bvhs = OrderedJson::array();
  for (const BvhReport& bvh : report.bvhs) bvhs.push_back(bvh_json(bvh));
  const OrderedJson json{{"version", report.version},
                         {"scene", report.scene},
                         {"width", report.width},
                         {"height", report.height},
                         {"triangles", report.triangles},
                         {"accelerator", report.accelerator},
                         {"bvhs", bvhs},
                         {"light_grids", grids_json(report.light_grids)}};
  return text_of(json) + "\n";
}

}  // namespace pah
