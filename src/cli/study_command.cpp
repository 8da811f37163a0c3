#include "cli/study_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <pah/load/load_scene.hpp>
#include <pah/load/mesh_file.hpp>
#include <pah/scene/world.hpp>

#include "base/extension.hpp"
#include "base/output_file.hpp"
#include "cli/terminal/console.hpp"
#include "report/study/rates/rates.hpp"
#include "report/study/stage.hpp"
#include "report/study/study.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

bool is_scene(const fs::path& file) {
  return lower_extension(file) == ".yaml" || lower_extension(file) == ".yml";
}

bool is_mesh(const fs::path& file) {
  return std::ranges::find(mesh_extensions(), lower_extension(file)) != mesh_extensions().end();
}

[[noreturn]] void fail(const Location& where, const std::string& message,
                       const std::string& excerpt = {}) {
  std::vector<LocatedError> errors;
  errors.push_back({where, message, excerpt, 0});
  throw SceneError(std::move(errors));
}

// The input of both parts of the study, from one file.
struct Subject {
  StudyMesh mesh;
  StudyScene scene;
};

void set_scene(const Scene& scene, Subject& subject) {
  subject.scene.world = make_world(scene);
  Scene& settings = subject.scene.settings;
  settings.film = scene.film;
  settings.render = scene.render;
  settings.influence_areas = scene.influence_areas;
  settings.acceleration = scene.acceleration;
}

void check(const StudyMesh& mesh, const fs::path& file) {
  const Aabb bounds = bounds_of(mesh.triangles());
  const char* fault = mesh.indices.empty()                 ? "there are no triangles to study"
                      : bounds.min == bounds.max           ? "all triangles are one point"
                      : mesh.indices.size() >= 1ULL << 31U ? "there are too many triangles"
                                                           : nullptr;
  if (fault != nullptr) fail({file.string(), 0, 0}, fault);
}

Subject load_study_scene(const fs::path& file) {
  Subject subject;
  set_scene(load_scene(file).scene, subject);
  subject.mesh.positions = subject.scene.world.positions;
  subject.mesh.indices = subject.scene.world.indices;
  check(subject.mesh, file);
  return subject;
}

Subject load_study_mesh(const fs::path& file) {
  // Without this check a missing file would be reported as faulty.
  if (!std::ifstream(file)) throw FileError("cannot read " + file.string());
  Subject subject;
  try {
    Mesh mesh = read_mesh(file);
    subject.mesh.positions = mesh.positions;
    subject.mesh.indices = mesh.triangles;
    check(subject.mesh, file);
    Scene stage = make_stage();
    put_on_stage(stage, std::move(mesh));
    set_scene(stage, subject);
  } catch (const MeshFileError& error) {
    fail({file.string(), error.line(), error.column()}, error.what(), error.excerpt());
  }
  return subject;
}

struct Subjects {
  std::vector<StudyMesh> meshes;
  std::vector<StudyScene> scenes;
};

// Loads all files and reports all their errors at once.
Subjects load_subjects(const std::vector<fs::path>& files) {
  Subjects subjects;
  std::vector<LocatedError> errors;
  for (const fs::path& file : files) {
    Subject subject;
    try {
      subject = is_scene(file) ? load_study_scene(file) : load_study_mesh(file);
    } catch (const SceneError& error) {
      errors.insert(errors.end(), error.errors().begin(), error.errors().end());
      continue;
    }
    // Names identify rows, so they must differ.
    std::string name = file.stem().string();
    if (std::ranges::find(subjects.meshes, name, &StudyMesh::name) != subjects.meshes.end())
      name = fmt::format("{} ({})", name, subjects.meshes.size() + 1);
    subject.mesh.name = subject.scene.name = name;
    subjects.meshes.push_back(std::move(subject.mesh));
    subjects.scenes.push_back(std::move(subject.scene));
  }
  if (!errors.empty()) throw SceneError(std::move(errors));
  return subjects;
}

void show_progress(double done, const std::string& stage) {
  say(fmt::format("\r{:3.0f} %  {}\x1b[K", 100 * done, stage));
}

}  // namespace

ExitCode run_study(const StudyArguments& arguments) {
  for (const fs::path& file : arguments.files)
    if (!is_scene(file) && !is_mesh(file))
      throw UsageError(fmt::format("cannot study {}; it takes .yaml, {}", file.string(),
                                   fmt::join(mesh_extensions(), ", ")));
  const fs::path& folder = arguments.output;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError("cannot write " + folder.string() + ": " + error.message());
  check_can_create(folder / "report.md");

  StudyConfig config;
  config.quick = arguments.quick;
  config.seed = arguments.seed;
  if (config.quick) config.rays = 5'000;
  if (arguments.rays > 0) config.rays = arguments.rays;
  const bool terminal = can_redraw();
  const auto progress =
      terminal ? show_progress : std::function<void(double, const std::string&)>{};
  const Subjects subjects = load_subjects(arguments.files);
  StudyResults results = pah::run_study(subjects.meshes, config, progress);
  results.rates = measure_rates(subjects.scenes, config, progress);
  if (terminal) say("\r\x1b[K");

  write_text_file(folder / "prediction.csv", prediction_csv(results));
  write_text_file(folder / "cost.csv", cost_csv(results));
  write_text_file(folder / "build.csv", build_csv(results));
  write_text_file(folder / "sweep.csv", sweep_csv(results));
  write_text_file(folder / "rays.csv", rays_csv(results));
  const bool plotted = write_study_plots(results, folder);
  write_text_file(folder / "report.md", study_markdown(results, plotted));
  say(fmt::format("wrote {}{}\n", (folder / "report.md").string(),
                  plotted ? "" : "; plots skipped: gnuplot was not found or failed"));
  return ExitCode::done;
}

}  // namespace pah::cli
