// The report of `inspect` on light grids.
#include "catch.hpp"
#include "report/inspect/inspect_report.hpp"

using namespace pah;

namespace {

GridReport built_grid() {
  constexpr GridPilot pilot{
      .expected_rays = 4e6, .rays = 200, .occluded_share = 0.25, .seconds = 1e-6, .cost = 40};
  GridReport grid{
      .light = "bulb",
      .plan = plan_grid(0, PointBundle{}, pilot, {.triangles = 9, .bvh_build_seconds = 0.1})};
  measure_grid(grid.plan, 5e-7, 0.5, 900, {});
  grid.build_seconds = 0.5;
  grid.bytes = 900;
  return grid;
}

}  // namespace

TEST_CASE("The text of a grid says what was predicted and measured") {
  GridReport grid = built_grid();
  CHECK(grid_text(grid) == R"(
Grid of light bulb: built
  reason            it is expected to save more than it costs
  expected rays     4000000
  pilot rays        200, of which 25.0 % are occluded
  per ray, BVH      1000.0 ns measured
  per ray, grid     375.0 ns predicted, 500.0 ns measured
  time saved        2.35 s predicted, 1.5 s measured
  memory            900 bytes
  build time        0.5 s
)");
  grid.lists = GridLists{12, 3, 40, 7};
  CHECK_THAT(grid_text(grid), contains_text("  cells             12, of which 25.0 % are empty\n"
                                            "  entries           40, at most 7 a cell\n"
                                            "  memory "));
}

TEST_CASE("The text of a grid that was not built says why, and what is known") {
  GridReport grid{.light = "sun", .plan = {}};
  grid.plan.reason = "no shadow rays are sent";
  CHECK(grid_text(grid) ==
        "\nGrid of light sun: not built\n  reason            no shadow rays are sent\n");
  grid.plan = plan_grid(0, PointBundle{}, {}, {});
  CHECK(
      grid_text(grid) ==
      "\nGrid of light sun: not built\n  reason            none of the pilot's rays goes to it\n");
}
