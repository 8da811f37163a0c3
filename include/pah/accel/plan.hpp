// What is built for which influence area, and why.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <string_view>

namespace pah {

struct AreaPlan {
  bool build = false;
  std::string_view reason;
};

// Whether an area is to have a BVH of its own.
[[nodiscard]] AreaPlan plan(const LocalArea& area);

}  // namespace pah
