// Repeats the thesis's experiments over any meshes: how well the heuristics predict the cost of
// rays, and how good the trees are that they build. Costs are counted in units of a box test
// (build_config.hpp), so they depend on the seed alone, not on the machine. Only build times and
// the rates of accelerators are measured.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <pah/accel/local_bvhs.hpp>
#include <string>
#include <vector>

namespace pah {

struct StudyMesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<UVec3> indices;

  [[nodiscard]] Triangles triangles() const { return {positions, indices}; }
};

struct StudyConfig {
  std::uint64_t rays = 100'000;  // per area, at least 1
  std::uint64_t seed = 1;
  bool quick = false;  // fewer areas
};

// The angle of an area's rays to the axes of the boxes, on which results mainly depend.
enum class StudyGroup : std::uint8_t {
  plane_axis,     // parallel rays along an axis
  plane_15,       // 15 degrees off one
  plane_45,       // halfway between two
  plane_oblique,  // far from all
  point_outside,  // of the mesh's bounding sphere
  point_inside
};
inline constexpr std::size_t study_groups = 6;
[[nodiscard]] const char* name_of(StudyGroup group);
[[nodiscard]] inline bool is_point(StudyGroup group) { return group >= StudyGroup::point_outside; }

// The tree of a row.
struct StudyCase {
  std::string mesh, area;
  StudyGroup group{};
  std::uint64_t triangles = 0;  // of the local BVH
  Heuristic heuristic{};
  SplitAxis split{};
};

// The expected cost of a ray that meets the root's box, by several measures, and the counted mean
// over rays of the bundle.
struct PredictionRow {
  StudyCase tree;
  double measured = 0;        // every node that the ray meets within the region
  double standard_error = 0;  // of that mean
  double closest = 0;         // the part that a search for the nearest hit visits
  double pah = 0;             // clipped to the region, in the measure that the rays are uniform in
  double pah_plane = 0;       // in the measure of the picture plane; the same for plane areas
  double pah_unclipped = 0;
  double sah = 0;
};

// The cost of rays in one tree of an area.
struct CostRow {
  StudyCase tree;
  // For a ray that meets the root, in the binary tree as built.
  double closest = 0;  // a search for the nearest hit
  double all = 0;      // every node that the ray meets within the region
  // For any ray, in the renderer's tree with eight children a node.
  double kernel = 0;
  double hit_share = 0;      // of all rays of the bundle
  double break_even = 0;     // the share of rays that must hit for the local BVH to pay
  double build_seconds = 0;  // CPU time
  double mean_depth = 0;     // of leaves, relative to an even tree
  std::uint32_t max_depth = 0;
  double lopsided = 0;  // see TreeBalance
};

struct SweepRow {
  StudyCase tree;
  std::string parameter;
  double value = 0;
  double cost = 0;
  double over_default = 0;
  double lopsided = 0;
};

// One measurement of one accelerator on the rays of a render.
struct RateRow {
  std::string scene;
  std::uint64_t triangles = 0;
  std::string ray_kind, accelerator;
  double batch = 0;  // rays a call, the mean
  unsigned threads = 1;
  unsigned repetition = 1;
  double rays_per_second = 0;
  std::optional<double> nodes_per_ray, triangles_per_ray;  // of those that count
  double build_seconds = 0;                                // by all threads
  std::uint64_t bytes = 0;
  std::uint64_t mismatches = 0;  // rays whose answer differs from bvh's
};

struct StudyResults {
  StudyConfig config;
  std::vector<PredictionRow> predictions;
  std::vector<CostRow> costs;
  std::vector<SweepRow> sweeps;
  std::vector<RateRow> rates;       // of measure_rates (rates.hpp)
  std::uint64_t skipped_areas = 0;  // in which no ray meets a triangle's box
};

// Runs the experiments. `progress(done, stage)`, with `done` in [0, 1], is called from time to
// time. Meshes need an extent and at least one triangle.
[[nodiscard]] StudyResults run_study(
    const std::vector<StudyMesh>& meshes, const StudyConfig& config,
    const std::function<void(double, const std::string&)>& progress = {});

[[nodiscard]] std::string prediction_csv(const StudyResults& results);
[[nodiscard]] std::string cost_csv(const StudyResults& results);
[[nodiscard]] std::string build_csv(const StudyResults& results);
[[nodiscard]] std::string sweep_csv(const StudyResults& results);
[[nodiscard]] std::string rays_csv(const StudyResults& results);
[[nodiscard]] std::string study_markdown(const StudyResults& results, bool with_plots);

// Writes gnuplot scripts into `folder` and runs them; returns false if gnuplot is missing or fails.
// Throws FileError.
bool write_study_plots(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace pah
