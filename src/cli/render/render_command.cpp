#include "cli/render/render_command.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <pah/image/clipping.hpp>
#include <pah/image/image_file.hpp>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>
#include <pah/scene/world.hpp>
#include <utility>

#include "base/extension.hpp"
#include "base/output_file.hpp"
#include "base/stopwatch.hpp"
#include "cli/merge/film_picture.hpp"
#include "cli/render/checkpoint.hpp"
#include "cli/render/early_pictures.hpp"
#include "cli/render/memory.hpp"
#include "cli/render/preview.hpp"
#include "cli/render/progress.hpp"
#include "cli/render/summary.hpp"
#include "cli/terminal/console.hpp"
#include "cli/terminal/film_size.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/warnings.hpp"
#include "cli/tev/stream.hpp"
#include "image/image_library.hpp"
#include "report/acceleration_warnings.hpp"
#include "report/stats.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

// Extensions are matched as write_image matches them: whatever their case.
bool has_image_extension(const fs::path& file) {
  return std::ranges::find(image_extensions(), lower_extension(file)) != image_extensions().end();
}

fs::path output_of(const RenderArguments& arguments) {
  const std::string named_after_scene = arguments.scene.stem().string() + ".png";
  if (arguments.output.empty()) return named_after_scene;
  if (has_image_extension(arguments.output) || is_film_file(arguments.output))
    return arguments.output;
  std::error_code ignored;
  if (!arguments.output.has_filename() || fs::is_directory(arguments.output, ignored))
    throw UsageError(fmt::format("-o {} is a directory; name a file in it: {}",
                                 arguments.output.string(),
                                 (arguments.output / named_after_scene).string()));
  throw UsageError(fmt::format("cannot tell the format of {} by its extension; available are {}",
                               arguments.output.string(), fmt::join(image_extensions(), ", ")));
}

// What is asked for and has no place in such a file.
void check_format(const RenderArguments& arguments, const fs::path& output) {
  const std::string extension = lower_extension(output);
  const auto require = [&](const char* option, const char* needed) {
    if (extension != needed)
      throw UsageError(
          fmt::format("{} is for {} files; the output is {}", option, needed, output.string()));
  };
  if (arguments.half) require("--half", ".exr");
  if (arguments.png_bits) require("--png-bits", ".png");
  if (arguments.sample_range) require("--samples", film_extension);
}

// A scene with layers may well be rendered to a PNG file, to look at.
void leave_out_layers(FilmSettings& film, const fs::path& output, Warnings& warnings) {
  if (lower_extension(output) == ".exr" || is_film_file(output)) return;
  if (film.albedo || film.normal || film.depth || film.variance)
    warnings.add(
        fmt::format("{} has no room for the 'channels' of film; .exr files have", output.string()));
  film.albedo = film.normal = film.depth = film.variance = false;
}

// What will look wrong for another reason than too few samples.
void warn_of_faults(const RenderResult& result, double exposure, const fs::path& output,
                    Warnings& warnings) {
  if (result.counts.nan_samples > 0)
    warnings.add(fmt::format("{} samples were not finite or negative, and left out",
                             result.counts.nan_samples));
  const std::string extension = lower_extension(output);
  if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") return;  // linear
  const Clipping clipping = measure_clipping(radiance_of(result.film), exposure);
  if (clipping.share > 0.05)
    warnings.add(fmt::format(
        "{:.0f} % of the pixels are too bright for {}; --exposure {:.1f} "
        "would fit",
        100 * clipping.share, output.string(), std::floor(10 * clipping.exposure) / 10));
}

void apply(const RenderArguments& arguments, Scene& scene) {
  resize(scene.film, arguments.width, arguments.height);
  scene.film.exposure = arguments.exposure.value_or(scene.film.exposure);
  scene.render.samples = arguments.samples.value_or(scene.render.samples);
  scene.render.seed = arguments.seed.value_or(scene.render.seed);
  if (arguments.sample_range) scene.render.samples = arguments.sample_range->to;
  if (arguments.crop) scene.film.crop = arguments.crop;

  const FilmSettings& film = scene.film;
  if (film.crop && (film.crop->x1 > film.width || film.crop->y1 > film.height))
    throw UsageError(fmt::format("the crop {},{},{},{} reaches beyond the {} x {} picture",
                                 film.crop->x0, film.crop->x1, film.crop->y0, film.crop->y1,
                                 film.width, film.height));
  if (!arguments.preview) return;
  scene.film = preview_of(film);
  scene.render.samples = arguments.samples.value_or(preview_samples);
}

bool any_samples(const Film& film) {
  return std::ranges::any_of(film.pixels, [](const FilmPixel& pixel) { return pixel.samples > 0; });
}

// By whatever names.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

bool is_done(const std::shared_future<void>& task) {
  return task.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// Once the task has failed, throws what it threw.
void rethrow_failure(const std::shared_future<void>& task) {
  if (is_done(task)) task.get();
}

// What writes the picture is needed last. A preview is to show something soon: there it gets what
// time the structures leave, at some cost to the whole.
void load_in_background(bool with_least_priority) {
  constexpr int least = 19;
  if (with_least_priority) (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), least);
  load_image_library();
}

PictureFormat format_of(const RenderArguments& arguments) {
  return {arguments.half, arguments.png_bits.value_or(8)};
}

void write_picture(const fs::path& file, const Film& film, int samples, double seconds,
                   const FilmOrigin& origin, const RenderArguments& arguments) {
  WriteOptions options = write_options(origin, samples, format_of(arguments));
  options.metadata.emplace_back("pahrender:seconds", fmt::format("{:.3f}", seconds));
  write_image(file, layers_of(film, origin.film), options);
}

void write_output(const fs::path& file, const RenderResult& result, const FilmOrigin& origin,
                  const RenderArguments& arguments) {
  if (is_film_file(file))
    write_film(file, origin, result.held, result.film);
  else
    write_picture(file, result.film, result.samples, result.seconds, origin, arguments);
}

// Those who look at the picture while it is rendered.
struct Onlookers {
  std::function<void(const std::string&)> warn;
  std::optional<EarlyPictures> early;
  std::optional<TevStream> tev;

  // By one thread at a time.
  void warn_of_faults() {
    if (!tev) return;
    if (const std::optional<std::string> fault = tev->take_fault()) warn(*fault);
  }
};

// `spent` seconds of the time limit are gone. Ends early if `loading`, of what will write the
// picture, fails. `saving` begins with the first samples: until then there is nothing that an
// interrupt should wait for.
RenderResult render_with_progress(const World& world, const Accelerator& accelerator,
                                  const Scene& scene, const RenderArguments& arguments,
                                  double spent, const std::shared_future<void>& loading,
                                  std::optional<SavingOnInterrupt>& saving, Onlookers& onlookers,
                                  StartedFilm started, Checkpoint& checkpoint) {
  RenderOptions options;
  options.threads = arguments.threads;
  // 0 would be none.
  if (arguments.time_limit > 0) options.time_limit = std::max(arguments.time_limit - spent, 1e-3);
  options.count_traversal = !arguments.stats.empty();
  options.stop = &stop_requested();
  const RenderGoal goal{scene.render.samples - started.samples.from, options.time_limit};
  // The library may come too late for the first passes, which nobody waits for: they are short.
  options.on_pass = [&](const Film& film, const FilmSamples& samples, const Progress& progress) {
    const bool last = samples.to == scene.render.samples;
    if (onlookers.early && !last && is_done(loading)) onlookers.early->show(film, progress);
    checkpoint.pass_done(film, samples);
  };
  if (onlookers.early) options.pass_seconds = arguments.write_every.value_or(0) / 2;
  if (onlookers.tev)
    options.on_tile = [&](const Film& film, const PixelRect& tile) {
      onlookers.tev->show(film, tile);
    };
  std::optional<ProgressBar> bar;
  if (!arguments.quiet && can_redraw()) bar.emplace(goal);
  Heartbeat heartbeat(goal);
  options.on_progress = [&](const Progress& progress) {
    rethrow_failure(loading);
    if (!saving) saving.emplace();
    onlookers.warn_of_faults();
    if (bar)
      bar->show(progress);
    else if (!arguments.quiet)
      say(heartbeat.line(progress));
  };
  return render(world, accelerator, scene.film, scene.render, options, std::move(started));
}

}  // namespace

ExitCode run_render(const RenderArguments& arguments, const RenderHooks& hooks) {
  const Stopwatch total;
  handle_interrupts();
  const fs::path output = output_of(arguments);
  check_format(arguments, output);
  if (!arguments.stats.empty() && is_same_file(output, arguments.stats))
    throw UsageError("--output and --stats name the same file");
  if (!arguments.check) {
    check_output(output);
    if (!arguments.stats.empty()) check_can_create(arguments.stats);
  }

  const int threads = arguments.threads > 0 ? arguments.threads : tbb::info::default_concurrency();
  // oneTBB does not go beyond the number of cores unless told to.
  const tbb::global_control parallelism(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
  LoadedScene loaded = load_scene(
      arguments.scene, {arguments.overrides, {}, hooks.on_file, hooks.loaded, arguments.frame});
  Scene& scene = loaded.scene;
  Warnings warnings(arguments.quiet, arguments.strict);
  warnings.add(loaded.warnings);
  if (arguments.frame && !loaded.animated)
    warnings.add("nothing in the scene depends on the frame");
  apply(arguments, scene);
  if (arguments.check) {
    if (warnings.failed()) return ExitCode::scene_error;
    if (!arguments.quiet) say(fmt::format("{}: no errors\n", arguments.scene.string()));
    return ExitCode::done;
  }
  leave_out_layers(scene.film, output, warnings);
  check_memory_for(scene.film);
  const FilmOrigin origin{PAHRENDER_VERSION, loaded.hash, scene.film, scene.render};
  const int first_sample = arguments.sample_range.value_or(IndexRange{}).from;
  if (arguments.keep_whole &&
      is_whole(output, origin, {first_sample, scene.render.samples, 0, {}}, format_of(arguments))) {
    if (!arguments.quiet) say(fmt::format("{} is there already\n", output.string()));
    return warnings.failed() ? ExitCode::scene_error : ExitCode::done;
  }
  Checkpoint checkpoint(output, origin, {arguments.checkpoint, arguments.resume, arguments.quiet},
                        warnings);
  StartedFilm started = checkpoint.start(first_sample);
  const World world = make_world(scene);
  warnings.add(world.warnings);
  if (warnings.failed()) return ExitCode::scene_error;
  // From here on everything comes from the world.
  scene.meshes = {};
  scene.instances = {};

  // Takes half a second, beside the work: on a thread of its own if there is one to be had.
  const std::shared_future<void> loading =
      std::async(load_in_background, arguments.preview).share();

  RenderReport report;
  report.seconds.load = total.seconds();
  const Stopwatch building;
  const Acceleration acceleration = tbb::task_arena(threads).execute(
      [&] { return make_acceleration(world, scene, arguments.accelerator); });
  report.seconds.build = building.seconds();
  warnings.add(warnings_of(acceleration, world, scene));
  if (warnings.failed()) return ExitCode::scene_error;

  Onlookers onlookers{[&](const std::string& warning) {
                        if (!arguments.quiet && can_redraw()) ProgressBar::wipe();
                        warnings.add(warning);
                      },
                      {},
                      {}};
  // What was written to a device cannot be replaced, and films are kept by checkpoints.
  if (arguments.write_every && !is_device(output) && !is_film_file(output)) {
    const auto write = [&](const Film& film, const Progress& progress) {
      write_picture(output, film, progress.samples_finished, progress.seconds, origin, arguments);
    };
    onlookers.early.emplace(*arguments.write_every, write, onlookers.warn);
  }
  if (arguments.tev) onlookers.tev.emplace(*arguments.tev, output.filename().string(), scene.film);
  std::optional<SavingOnInterrupt> saving;
  const RenderResult result =
      render_with_progress(world, *acceleration.accelerator, scene, arguments, total.seconds(),
                           loading, saving, onlookers, std::move(started), checkpoint);
  if (!result.complete) checkpoint.keep(result.film, result.held);
  const bool interrupted = stop_requested() && !result.complete;
  if (interrupted && hooks.outdated != nullptr && *hooks.outdated) return ExitCode::interrupted;
  // Less than one sample for every pixel is better than nothing, but not than what there was.
  std::error_code ignored;
  const bool replaces = fs::is_regular_file(output, ignored);
  if (interrupted && (replaces ? result.samples == 0 : !any_samples(result.film))) {
    say(replaces ? fmt::format("interrupted before every pixel had a sample; {} is as it was\n",
                               output.string())
                 : "interrupted before there was anything to save\n");
    return ExitCode::interrupted;
  }
  write_output(output, result, origin, arguments);
  if (result.complete) checkpoint.remove();
  if (onlookers.tev) onlookers.tev->finish();
  onlookers.warn_of_faults();
  warn_of_faults(result, scene.film.exposure, output, warnings);
  if (!arguments.quiet)
    say(summary_of(output, result, scene.render.samples - result.held.from, total.seconds()));

  if (!arguments.stats.empty()) {
    report.version = PAHRENDER_VERSION;
    report.scene = arguments.scene.string();
    report.width = scene.film.width;
    report.height = scene.film.height;
    report.samples = result.samples;
    report.mean_samples = mean_samples(result.film);
    report.threads = threads;
    report.seed = scene.render.seed;
    report.accelerator = acceleration.name;
    report.triangles = world.triangles().size();
    report.counts = result.counts;
    report.scene_bytes = world.bytes();
    report.film_bytes = result.film.bytes();
    report.accelerator_bytes = acceleration.accelerator->memory();
    report.influence_areas = report_areas(acceleration);
    report.light_grids = report_grids(acceleration, world);
    report.error = estimate_error(result.film);
    report.warnings = warnings.count();
    report.seconds.render = result.seconds;
    report.seconds.total = total.seconds();
    write_text_file(arguments.stats, stats_json(report));
  }
  if (interrupted) return ExitCode::interrupted;
  return warnings.failed() ? ExitCode::scene_error : ExitCode::done;
}

}  // namespace pah::cli
