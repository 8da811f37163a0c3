// The output of --stats, a contract for tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>
#include <string>
#include <vector>

#include "report/grid_report.hpp"

namespace pah {

// An influence area and its costs.
struct AreaReport {
  std::string name, type, light;
  std::uint64_t triangles = 0;  // in its BVH
  bool built = false;
  std::string reason;  // for building it or not
  // Costs per ray, by the cost model of build_config.hpp; null in the JSON if nothing was built or
  // measured.
  std::optional<double> predicted_cost, measured_cost;      // in its BVH
  std::optional<double> global_cost, measured_global_cost;  // in that of the whole scene
  std::optional<std::uint64_t> rays;                        // answered by the area alone
  std::optional<std::uint64_t> asked_rays;                  // the basis of measured_cost
  std::optional<std::uint64_t> sampled_rays;  // of them, the basis of measured_global_cost
};

struct RenderReport {
  std::string version;
  std::string scene;  // the name on the command line
  int width = 0, height = 0;
  int samples = 0;          // per pixel, finished by every pixel
  double mean_samples = 0;  // per pixel
  int threads = 0;
  std::uint64_t seed = 0;
  std::string accelerator;
  std::uint64_t triangles = 0;
  struct {
    double load = 0, build = 0, render = 0, total = 0;
  } seconds;
  RenderCounts counts;
  std::uint64_t scene_bytes = 0, film_bytes = 0;
  AcceleratorMemory accelerator_bytes;
  std::vector<AreaReport> influence_areas;
  std::vector<GridReport> light_grids;
  ErrorEstimate error;
  int warnings = 0;
};

// Reports on the areas after a render that counted its traversal.
[[nodiscard]] std::vector<AreaReport> report_areas(const Acceleration& acceleration);

// Returns the peak memory of this process, in bytes.
[[nodiscard]] std::uint64_t peak_memory_bytes();

[[nodiscard]] std::string stats_json(const RenderReport& report);

}  // namespace pah
