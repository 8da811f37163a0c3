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

}  // namespace pah
