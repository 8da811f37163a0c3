#include "bvh/instruction_set.hpp"

#include <hwy/targets.h>

namespace pah {

const char* instruction_set() {
  // The lowest bit stands for the best target.
  const auto targets = static_cast<std::int64_t>(hwy::SupportedTargets() & HWY_TARGETS);
  return hwy::TargetName(targets & -targets);
}

}  // namespace pah
