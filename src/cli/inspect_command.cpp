#include "cli/inspect_command.hpp"

#include <fmt/format.h>

#include <pah/image/image_file.hpp>
#include <pah/influence/bundle_area.hpp>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/scene/world.hpp>

#include "accel/local/build_local.hpp"
#include "base/output_file.hpp"
#include "base/stopwatch.hpp"
#include "bvh/bvh_cost.hpp"
#include "cli/terminal/console.hpp"
#include "cli/terminal/film_size.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/warnings.hpp"
#include "report/acceleration_warnings.hpp"
#include "report/inspect/inspect_report.hpp"
#include "report/inspect/pictures/area_lines.hpp"
#include "report/inspect/pictures/box_lines.hpp"
#include "report/inspect/pictures/false_color.hpp"
#include "report/inspect/pictures/overlay.hpp"
#include "report/inspect/pictures/structure_map.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

// Throws before the work begins rather than after it.
void check_outputs(const InspectArguments& arguments) {
  const auto check_extension = [](const fs::path& file, std::string_view option,
                                  std::string_view extension) {
    if (!file.empty() && file.extension() != extension)
      throw UsageError(fmt::format("{} writes {} files; {} has another extension", option,
                                   extension, file.string()));
  };
  check_extension(arguments.heat_map, "--heatmap", ".png");
  check_extension(arguments.structures, "--structures", ".png");
  check_extension(arguments.overlay, "--overlay", ".png");
  for (const fs::path* file :
       {&arguments.json, &arguments.heat_map, &arguments.structures, &arguments.overlay})
    if (!file->empty()) check_can_create(*file);
}

struct TimedBvh {
  BuiltBvh built;
  double seconds = 0;
};

// Builds the same BVH as a render without influence areas.
TimedBvh build_global(const Triangles& triangles) {
  const Stopwatch building;
  BuiltBvh built = build_bvh(triangles);
  return {std::move(built), building.seconds()};
}

double cost_within_root(const BuiltBvh& built, const BoxMeasure& measure) {
  if (built.tree.empty()) return 0;
  return expected_cost(built.bvh, measure, measure_of(measure, built.tree.nodes.front().box));
}

BvhReport report_local(const World& world, const SceneArea& area, const LocalConfig& config,
                       const Bvh& global, const AreaRayCosts& rays) {
  const BuiltLocalBvh local = build_local_bvh(world.triangles(), area.area, config);
  const BoxMeasure probability = each_box(HitProbability(area.area));
  return {.name = area.name,
          .heuristic = label_of(config.heuristic),
          .tree = summarize(local.built.tree, probability),
          .wide_nodes = local.built.bvh.nodes.size(),
          .expected_cost = cost_within_root(local.built, probability),
          .surface_cost = cost_within_root(local.built, each_box(SurfaceArea{})),
          .camera_rays = std::nullopt,
          .bundle =
              BundleCosts{bundle_cost(local.built.bvh, area.area), bundle_cost(global, area.area)},
          .area_rays = rays,
          .seen = seen_overlaps(local.built.tree, area.area),
          .memory_bytes = local.built.bvh.memory_bytes(),
          .build_seconds = local.seconds};
}

// Returns the areas that a render builds, or all areas.
std::vector<SceneArea> reported_areas(const Acceleration& acceleration, bool all_areas) {
  std::vector<SceneArea> areas;
  for (const AreaStatus& status : acceleration.areas)
    if (status.plan.build || all_areas) areas.push_back(status.area);
  return areas;
}

std::vector<BvhReport> report_areas(const World& world, const std::vector<SceneArea>& areas,
                                    const Scene& scene, const Bvh& global) {
  std::vector<LocalArea> built;
  built.reserve(areas.size());
  for (const SceneArea& area : areas) built.push_back(local_area(area));
  const LocalConfig& config = scene.acceleration.local;
  const std::vector<AreaRayCosts> costs =
      measure_area_costs(world, global, built, config, scene.film);
  std::vector<BvhReport> reports;
  reports.reserve(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i)
    reports.push_back(report_local(world, areas[i], config, global, costs[i]));
  return reports;
}

void write_structures(const fs::path& file, const World& world, const Acceleration& acceleration,
                      const FilmSettings& film) {
  const StructureMap map = map_structures(world, acceleration, film);
  write_image(file, {{"", {"R", "G", "B"}, map.image}});
  fmt::print("\nstructure map {}: what answers shadow rays; black where there are none\n{}",
             file.string(), legend_text(map.legend));
}

void write_overlay(const InspectArguments& arguments, const World& world, const Scene& scene,
                   const Acceleration& acceleration, const BinaryTree& global,
                   const std::vector<SceneArea>& areas) {
  const Accelerator& accelerator = *acceleration.accelerator;
  Image picture = draft_picture(world, accelerator, scene);
  draw_over(picture, world, accelerator, scene.film, box_lines(global, arguments.levels),
            area_lines(areas));
  write_image(arguments.overlay, {{"", {"R", "G", "B"}, std::move(picture)}});
  fmt::print("\noverlay {}: {} of {} influence areas; thin lines are boxes of the global BVH\n{}",
             arguments.overlay.string(), areas.size(), acceleration.areas.size(),
             legend_text(area_legend(areas)));
}

}  // namespace

ExitCode run_inspect(const InspectArguments& arguments) {
  handle_interrupts();
  check_outputs(arguments);
  LoadedScene loaded = load_scene(arguments.scene, {arguments.overrides, {}});
  Warnings warnings(false, false);
  warnings.add(loaded.warnings);
  Scene& scene = loaded.scene;
  resize(scene.film, arguments.width, arguments.height);
  const World world = make_world(scene);
  warnings.add(world.warnings);

  const TimedBvh global = build_global(world.triangles());
  const BoxMeasure surface_area = each_box(SurfaceArea{});
  const PictureCosts costs = measure_costs(global.built.bvh, world.camera, scene.film);
  InspectReport report;
  report.version = PAHRENDER_VERSION;
  report.scene = arguments.scene.string();
  report.width = scene.film.width;
  report.height = scene.film.height;
  report.triangles = world.triangles().size();
  report.bvhs.push_back({.name = "global",
                         .heuristic = label_of(Heuristic::surface_area),
                         .tree = summarize(global.built.tree, surface_area),
                         .wide_nodes = global.built.bvh.nodes.size(),
                         .expected_cost = cost_within_root(global.built, surface_area),
                         .surface_cost = cost_within_root(global.built, surface_area),
                         .camera_rays = summarize(costs),
                         .bundle = std::nullopt,
                         .area_rays = std::nullopt,
                         .seen = std::nullopt,
                         .memory_bytes = global.built.bvh.memory_bytes(),
                         .build_seconds = global.seconds});

  // Chooses structures as a render does.
  const Acceleration acceleration = make_acceleration(world, scene);
  warnings.add(warnings_of(acceleration, world, scene));
  const std::vector<SceneArea> areas = reported_areas(acceleration, arguments.all_areas);
  for (BvhReport& area : report_areas(world, areas, scene, global.built.bvh))
    report.bvhs.push_back(std::move(area));
  report.accelerator = acceleration.name;
  report.light_grids = report_grids(acceleration, world);

  fmt::print("{}", inspect_text(report));
  if (!arguments.json.empty()) write_text_file(arguments.json, inspect_json(report));
  if (!arguments.heat_map.empty()) {
    const CostSummary summary = summarize(costs);
    write_image(arguments.heat_map, {{"", {"R", "G", "B"}, heat_map(costs)}});
    fmt::print("\nheat map {}: white is {} nodes on the left, {} triangles on the right\n",
               arguments.heat_map.string(), summary.max_nodes, summary.max_triangles);
  }
  if (!arguments.structures.empty())
    write_structures(arguments.structures, world, acceleration, scene.film);
  if (!arguments.overlay.empty())
    write_overlay(arguments, world, scene, acceleration, global.built.tree, areas);
  return ExitCode::done;
}

}  // namespace pah::cli
