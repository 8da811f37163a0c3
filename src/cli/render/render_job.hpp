// One render, in four stages: load, build, trace, save.
#pragma once

#include <tbb/global_control.h>

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>
#include <pah/scene/world.hpp>

#include "base/stopwatch.hpp"
#include "cli/render/checkpoint.hpp"
#include "cli/render/early_pictures.hpp"
#include "cli/render/render_command.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/warnings.hpp"
#include "cli/tev/stream.hpp"
#include "report/stats.hpp"

namespace pah::cli {

// Call the stages in the order of their declaration. If a stage returns an exit code, the render
// ends with it. Each stage throws as run_render does.
class RenderJob {
 public:
  // The arguments and hooks must outlive the job.
  RenderJob(const RenderArguments& arguments, const RenderHooks& hooks);

  [[nodiscard]] std::optional<ExitCode> load();
  [[nodiscard]] std::optional<ExitCode> build();
  void trace();
  [[nodiscard]] ExitCode save();

 private:
  // Applies the options, which override the scene.
  void apply_arguments();
  void open_onlookers();
  [[nodiscard]] RenderOptions render_options();
  [[nodiscard]] bool picture_library_loaded() const;
  void warn_of_viewer();
  // After an interrupt: returns whether the picture is not worth saving, and says why.
  [[nodiscard]] bool nothing_to_save() const;
  void write_output();
  void write_stats();
  [[nodiscard]] ExitCode ending(bool interrupted = false) const;

  const RenderArguments& arguments_;
  const RenderHooks& hooks_;
  Stopwatch total_;
  std::filesystem::path output_;
  int threads_;
  tbb::global_control parallelism_;
  Warnings warnings_;
  RenderReport report_;

  // Set by load().
  Scene scene_;
  FilmOrigin origin_;
  std::unique_ptr<Checkpoint> checkpoint_;
  StartedFilm started_;
  World world_;

  // Set by build(). The picture library takes half a second to load, and is needed last.
  std::shared_future<void> picture_library_;
  Acceleration acceleration_;

  // Set by trace(): viewers of the unfinished picture, and the result.
  std::optional<EarlyPictures> early_;
  std::optional<TevStream> tev_;
  // Exists from the first samples on: before them an interrupt has nothing to save.
  std::optional<SavingOnInterrupt> saving_;
  RenderResult result_;
};

}  // namespace pah::cli
