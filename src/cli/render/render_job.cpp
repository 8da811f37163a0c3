#include "cli/render/render_job.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/output_file.hpp"
#include "cli/merge/film_picture.hpp"
#include "cli/render/memory.hpp"
#include "cli/render/output.hpp"
#include "cli/render/preview.hpp"
#include "cli/terminal/console.hpp"
#include "cli/terminal/film_size.hpp"
#include "cli/terminal/progress.hpp"
#include "cli/terminal/summary.hpp"
#include "image/image_library.hpp"
#include "report/acceleration_warnings.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

bool any_samples(const Film& film) {
  return std::ranges::any_of(film.pixels, [](const FilmPixel& pixel) { return pixel.samples > 0; });
}

// A preview should appear soon, so it loads the library only in the time that building leaves.
void load_picture_library(bool with_least_priority) {
  constexpr int least = 19;
  if (with_least_priority) (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), least);
  load_image_library();
}

}  // namespace

RenderJob::RenderJob(const RenderArguments& arguments, const RenderHooks& hooks)
    : arguments_(arguments),
      hooks_(hooks),
      output_(checked_output(arguments)),
      threads_(arguments.threads > 0 ? arguments.threads : tbb::info::default_concurrency()),
      // By default oneTBB limits itself to the number of cores.
      parallelism_(tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(threads_)),
      warnings_(arguments.quiet, arguments.strict) {}

std::optional<ExitCode> RenderJob::load() {
  LoadedScene loaded =
      load_scene(arguments_.scene,
                 {arguments_.overrides, {}, hooks_.on_file, hooks_.loaded, arguments_.frame});
  scene_ = std::move(loaded.scene);
  warnings_.add(loaded.warnings);
  if (arguments_.frame && !loaded.animated)
    warnings_.add("nothing in the scene depends on the frame");
  apply_arguments();
  if (arguments_.check) {
    if (!warnings_.failed() && !arguments_.quiet)
      say(fmt::format("{}: no errors\n", arguments_.scene.string()));
    return ending();
  }
  leave_out_layers(scene_.film, output_, warnings_);
  check_memory_for(scene_.film);
  origin_ = {PAHRENDER_VERSION, loaded.hash, scene_.film, scene_.render};
  const int first_sample = arguments_.sample_range.value_or(IndexRange{}).from;
  if (arguments_.keep_whole &&
      is_whole(output_, origin_, {first_sample, scene_.render.samples, 0, {}},
               format_of(arguments_))) {
    if (!arguments_.quiet) say(fmt::format("{} is already complete\n", output_.string()));
    return ending();
  }
  checkpoint_ = std::make_unique<Checkpoint>(
      output_, origin_,
      CheckpointOptions{arguments_.checkpoint, arguments_.resume, arguments_.quiet}, warnings_);
  started_ = checkpoint_->start(first_sample);
  world_ = make_world(scene_);
  warnings_.add(world_.warnings);
  if (warnings_.failed()) return ending();
  // From here on the world holds all geometry.
  scene_.meshes = {};
  scene_.instances = {};
  return std::nullopt;
}

void RenderJob::apply_arguments() {
  resize(scene_.film, arguments_.width, arguments_.height);
  scene_.film.exposure = arguments_.exposure.value_or(scene_.film.exposure);
  scene_.render.samples = arguments_.samples.value_or(scene_.render.samples);
  scene_.render.seed = arguments_.seed.value_or(scene_.render.seed);
  if (arguments_.sample_range) scene_.render.samples = arguments_.sample_range->to;
  if (arguments_.crop) scene_.film.crop = arguments_.crop;

  const FilmSettings& film = scene_.film;
  if (film.crop && (film.crop->x1 > film.width || film.crop->y1 > film.height))
    throw UsageError(fmt::format("the crop {},{},{},{} reaches beyond the {} x {} picture",
                                 film.crop->x0, film.crop->x1, film.crop->y0, film.crop->y1,
                                 film.width, film.height));
  if (!arguments_.preview) return;
  scene_.film = preview_of(film);
  scene_.render.samples = arguments_.samples.value_or(preview_samples);
}

std::optional<ExitCode> RenderJob::build() {
  picture_library_ = std::async(load_picture_library, arguments_.preview).share();
  report_.seconds.load = total_.seconds();
  const Stopwatch building;
  acceleration_ = tbb::task_arena(threads_).execute(
      [&] { return make_acceleration(world_, scene_, arguments_.accelerator); });
  report_.seconds.build = building.seconds();
  warnings_.add(warnings_of(acceleration_, world_, scene_));
  if (warnings_.failed()) return ending();
  return std::nullopt;
}

void RenderJob::open_onlookers() {
  // A device cannot be rewritten, and for films there are checkpoints.
  if (arguments_.write_every && !is_device(output_) && !is_film_file(output_)) {
    const auto write = [&](const Film& film, const Progress& progress) {
      write_picture(output_, film, progress.samples_finished, progress.seconds, origin_,
                    arguments_);
    };
    const auto warn = [&](const std::string& warning) {
      if (!arguments_.quiet && can_redraw()) ProgressBar::wipe();
      warnings_.add(warning);
    };
    early_.emplace(*arguments_.write_every, write, warn);
  }
  if (arguments_.tev) tev_.emplace(*arguments_.tev, output_.filename().string(), scene_.film);
}

bool RenderJob::picture_library_loaded() const {
  return picture_library_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void RenderJob::warn_of_viewer() {
  if (!tev_) return;
  if (const std::optional<std::string> fault = tev_->take_fault()) {
    if (!arguments_.quiet && can_redraw()) ProgressBar::wipe();
    warnings_.add(*fault);
  }
}

RenderOptions RenderJob::render_options() {
  RenderOptions options;
  options.threads = arguments_.threads;
  // At least a millisecond, as a limit of 0 means no limit.
  if (arguments_.time_limit > 0)
    options.time_limit = std::max(arguments_.time_limit - total_.seconds(), 1e-3);
  options.count_traversal = !arguments_.stats.empty();
  options.stop = &stop_requested();
  // The first passes may end before the picture library is loaded: they are not written.
  options.on_pass = [&](const Film& film, const FilmSamples& samples, const Progress& progress) {
    const bool last = samples.to == scene_.render.samples;
    if (early_ && !last && picture_library_loaded()) early_->show(film, progress);
    checkpoint_->pass_done(film, samples);
  };
  if (early_) options.pass_seconds = arguments_.write_every.value_or(0) / 2;
  if (tev_)
    options.on_tile = [&](const Film& film, const PixelRect& tile) { tev_->show(film, tile); };
  return options;
}

void RenderJob::trace() {
  open_onlookers();
  RenderOptions options = render_options();
  const RenderGoal goal{scene_.render.samples - started_.samples.from, options.time_limit};
  std::optional<ProgressBar> bar;
  if (!arguments_.quiet && can_redraw()) bar.emplace(goal);
  Heartbeat heartbeat(goal);
  options.on_progress = [&](const Progress& progress) {
    // If the picture library failed to load, get() throws the reason and ends the render now.
    if (picture_library_loaded()) picture_library_.get();
    if (!saving_) saving_.emplace();
    warn_of_viewer();
    if (bar)
      bar->show(progress);
    else if (!arguments_.quiet)
      say(heartbeat.line(progress));
  };
  result_ = render(world_, *acceleration_.accelerator, scene_.film, scene_.render, options,
                   std::move(started_));
  if (!result_.complete) checkpoint_->keep(result_.film, result_.held);
}

ExitCode RenderJob::save() {
  const bool interrupted = stop_requested() && !result_.complete;
  if (interrupted && hooks_.outdated != nullptr && *hooks_.outdated) return ExitCode::interrupted;
  if (interrupted && nothing_to_save()) return ExitCode::interrupted;
  write_output();
  if (result_.complete) checkpoint_->remove();
  if (tev_) tev_->finish();
  warn_of_viewer();
  warn_of_faults(result_, scene_.film.exposure, output_, warnings_);
  if (!arguments_.quiet)
    say(summary_of(output_, result_, scene_.render.samples - result_.held.from, total_.seconds()));
  if (!arguments_.stats.empty()) write_stats();
  return ending(interrupted);
}

// A picture in which some pixels have no sample is better than no picture, but it must not replace
// an older one.
bool RenderJob::nothing_to_save() const {
  std::error_code ignored;
  const bool replaces = fs::is_regular_file(output_, ignored);
  if (replaces ? result_.samples > 0 : any_samples(result_.film)) return false;
  say(replaces ? fmt::format("interrupted before every pixel had a sample; {} is unchanged\n",
                             output_.string())
               : "interrupted before there was anything to save\n");
  return true;
}

void RenderJob::write_output() {
  if (is_film_file(output_))
    write_film(output_, origin_, result_.held, result_.film);
  else
    write_picture(output_, result_.film, result_.samples, result_.seconds, origin_, arguments_);
}

void RenderJob::write_stats() {
  report_.version = PAHRENDER_VERSION;
  report_.scene = arguments_.scene.string();
  report_.width = scene_.film.width;
  report_.height = scene_.film.height;
  report_.samples = result_.samples;
  report_.mean_samples = mean_samples(result_.film);
  report_.threads = threads_;
  report_.seed = scene_.render.seed;
  report_.accelerator = acceleration_.name;
  report_.triangles = world_.triangles().size();
  report_.counts = result_.counts;
  report_.scene_bytes = world_.bytes();
  report_.film_bytes = result_.film.bytes();
  report_.accelerator_bytes = acceleration_.accelerator->memory();
  report_.influence_areas = report_areas(acceleration_);
  report_.light_grids = report_grids(acceleration_, world_);
  report_.error = estimate_error(result_.film);
  report_.warnings = warnings_.count();
  report_.seconds.render = result_.seconds;
  report_.seconds.total = total_.seconds();
  write_text_file(arguments_.stats, stats_json(report_));
}

ExitCode RenderJob::ending(bool interrupted) const {
  if (interrupted) return ExitCode::interrupted;
  return warnings_.failed() ? ExitCode::scene_error : ExitCode::done;
}

}  // namespace pah::cli
