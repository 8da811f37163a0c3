#include <pah/accel/plan.hpp>

namespace pah {

// Derived areas hold all that their rays may meet, mostly the whole scene. A BVH in world space
// over that puts as many nodes in a ray's way as the global one, whatever it is built by, and costs
// a build. (A declared area can be tight about what matters.) A structure in the bundle's own
// coordinates may change that, and then this is the place to say so.
AreaPlan plan(const LocalArea& area) {
  if (area.declared) return {true, "declared"};
  return {false,
          "a local BVH in world space is not expected to beat the global one; declare the area to "
          "build it"};
}

// By the benchmarks of rays and builds: the BVH of fewer triangles lies in the caches and answers
// as fast; of more, a grid takes a triangle as long to build as RAYS look-ups save. That is taken
// twice, since what rays a render sends is only guessed.
GridPlan plan_grid(std::uint32_t bundle, std::size_t triangles, double expected_rays) {
  constexpr std::size_t fewest_triangles = 10'000;
  constexpr double rays_a_triangle = 2 * 16;
  if (triangles < fewest_triangles)
    return {bundle, expected_rays, false, "the BVH of so few triangles is as fast as a grid"};
  if (expected_rays < rays_a_triangle * static_cast<double>(triangles))
    return {bundle, expected_rays, false,
            "so few rays are expected that a grid would cost more than it saves"};
  return {bundle, expected_rays, true,
          "so many rays are expected that a grid saves more than it costs"};
}

}  // namespace pah
