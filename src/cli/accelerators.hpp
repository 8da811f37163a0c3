// The accelerators that --accel knows, by name, and the one that a render takes.
#pragma once

#include <memory>
#include <pah/accel/local_bvhs.hpp>
#include <pah/scene/areas.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/stats.hpp"

namespace pah::cli {

struct AcceleratorName {
  std::string_view name;
  std::string_view what;
};

[[nodiscard]] std::span<const AcceleratorName> accelerators();

[[nodiscard]] bool is_accelerator(std::string_view name);

// How a scene's acceleration settings have local BVHs built.
[[nodiscard]] LocalConfig local_config(const AccelerationSettings& settings);

struct ChosenAccelerator {
  std::string name;
  std::unique_ptr<Accelerator> accelerator;
  std::vector<SceneArea> areas;
  std::vector<AreaChoice> choices;   // for each area
  const LocalBvhs* local = nullptr;  // the accelerator, if it has areas: those chosen, in order
};

// `name` is that of an accelerator, or empty: then it is local if the scene has an area to build,
// and bvh otherwise. Builds by the calling arena's threads.
[[nodiscard]] ChosenAccelerator make_accelerator(std::string_view name, const World& world,
                                                 const Scene& settings);

// After a render that counted its traversal.
[[nodiscard]] std::vector<AreaReport> report_areas(const ChosenAccelerator& chosen);

}  // namespace pah::cli
