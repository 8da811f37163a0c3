// Tests the grids in the output of --stats.
#include "report/stats.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <pah/scene/shapes.hpp>

#include "catch.hpp"

using namespace pah;
using Json = nlohmann::ordered_json;

namespace {

const std::vector<std::string> keys{"light",
                                    "built",
                                    "reason",
                                    "expected_rays",
                                    "pilot_rays",
                                    "occluded_share",
                                    "bvh_seconds_per_ray",
                                    "bvh_cost_per_ray",
                                    "predicted_seconds_per_ray",
                                    "measured_seconds_per_ray",
                                    "predicted_build_seconds",
                                    "build_seconds",
                                    "predicted_saved_seconds",
                                    "saved_seconds",
                                    "bytes",
                                    "cells",
                                    "empty_cells",
                                    "entries",
                                    "longest_list"};

// Returns the JSON of a single grid, with its keys checked.
Json grid_of(const GridReport& grid) {
  RenderReport report;
  report.light_grids = {grid};
  const Json grids = Json::parse(stats_json(report)).at("light_grids");
  REQUIRE(grids.size() == 1);
  std::vector<std::string> names;
  for (const auto& [name, value] : grids[0].items()) names.push_back(name);
  CHECK(names == keys);
  return grids[0];
}

// Returns the names of the keys that are null.
std::vector<std::string> unknown_of(const GridReport& grid) {
  const Json json = grid_of(grid);
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items())
    if (value.is_null()) names.push_back(name);
  return names;
}

std::vector<std::string> keys_from(const std::string& first) {
  return {std::ranges::find(keys, first), keys.end()};
}

constexpr GridPilot pilot{
    .expected_rays = 4e6, .rays = 100, .occluded_share = 0.25, .seconds = 1e-6, .cost = 9};

}  // namespace

TEST_CASE("For a light without a pilot only the reason is known") {
  GridReport grid{.light = "sun", .plan = {}};
  grid.plan.reason = "no shadow rays are sent";
  const Json json = grid_of(grid);
  CHECK(json["light"] == "sun");
  CHECK(json["built"] == false);
  CHECK(json["reason"] == "no shadow rays are sent");
  CHECK(unknown_of(grid) == keys_from("expected_rays"));
}

TEST_CASE("For a light without rays the count is known, but no time") {
  GridReport grid{.light = "sun", .plan = plan_grid(0, PointBundle{}, {}, {.triangles = 9})};
  const Json json = grid_of(grid);
  CHECK(json["expected_rays"] == 0);
  CHECK(json["pilot_rays"] == 0);
  CHECK(unknown_of(grid) == keys_from("occluded_share"));
}

TEST_CASE("The measured values of a grid that is only planned are unknown") {
  const GridPlan plan = plan_grid(0, PointBundle{}, pilot, {.bvh_build_seconds = 9});
  CHECK(unknown_of({.light = "sun", .plan = plan}) ==
        std::vector<std::string>{"measured_seconds_per_ray", "build_seconds", "saved_seconds",
                                 "bytes", "cells", "empty_cells", "entries", "longest_list"});
}

TEST_CASE("All values of a built grid are known") {
  GridPlan plan = plan_grid(0, PointBundle{}, pilot, {.triangles = 9, .bvh_build_seconds = 0.1});
  measure_grid(plan, 5e-7, 0.5, 900, {});
  const GridReport grid{.light = "sun",
                        .plan = plan,
                        .build_seconds = 0.5,
                        .bytes = 900,
                        .lists = GridLists{12, 3, 40, 7}};
  const Json json = grid_of(grid);
  CHECK(unknown_of(grid).empty());
  CHECK(json["built"] == true);
  CHECK(json["expected_rays"] == 4e6);
  CHECK(json["pilot_rays"] == 100);
  CHECK(json["occluded_share"] == 0.25);
  CHECK(json["bvh_seconds_per_ray"] == 1e-6);
  CHECK(json["bvh_cost_per_ray"] == 9);
  CHECK(json["predicted_seconds_per_ray"] == plan.predicted_seconds);
  CHECK(json["measured_seconds_per_ray"] == 5e-7);
  CHECK(json["predicted_build_seconds"] == plan.predicted_build_seconds);
  CHECK(json["build_seconds"] == 0.5);
  CHECK(json["predicted_saved_seconds"] == plan.predicted_saving);
  CHECK(json["saved_seconds"].get<double>() == Approx(1.5));
  CHECK(json["bytes"] == 900);
  CHECK(json["cells"] == 12);
  CHECK(json["empty_cells"] == 3);
  CHECK(json["entries"] == 40);
  CHECK(json["longest_list"] == 7);
}

TEST_CASE("Grids are reported by their lights' names, built or not") {
  Scene scene;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(SphereShape{})};
  scene.instances.emplace_back();
  scene.lights.push_back({"sky", EnvironmentLight{}});
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 4, 0)}});
  scene.lights.push_back({"sun", DirectionalLight{}});
  const World world = make_world(scene);
  for (const std::string_view name : {"bvh", "light"}) {
    const std::vector<GridReport> grids =
        report_grids(make_acceleration(world, scene, name), world);
    REQUIRE(grids.size() == 2);
    CHECK(grids[0].light == "bulb");
    CHECK(grids[1].light == "sun");
    for (const GridReport& grid : grids) {
      CHECK(grid.plan.build == (name == "light"));
      CHECK((grid.bytes.value_or(0) > 0) == (name == "light"));
      CHECK(grid.build_seconds.has_value() == (name == "light"));
    }
  }
}
