// The program: parses the command line, runs a command and returns its exit code.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <pah/render/acceleration.hpp>

#include "cli/compare_command.hpp"
#include "cli/inspect_command.hpp"
#include "cli/merge/merge_command.hpp"
#include "cli/option_values.hpp"
#include "cli/render/frames.hpp"
#include "cli/render/render_command.hpp"
#include "cli/study_command.hpp"
#include "cli/terminal/console.hpp"
#include "cli/terminal/exit_code.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/report_exception.hpp"
#include "cli/watch/watch_command.hpp"
#include "load/yaml/suggest.hpp"

namespace pah::cli {
namespace {

void add_render_options(CLI::App& app, RenderArguments& arguments) {
  app.add_option("SCENE", arguments.scene, "The scene to render, a YAML file")->type_name("");
  app.add_option("-o,--output", arguments.output,
                 "The picture: .png or .jpg (for screens), .exr, .hdr\n"
                 "or .tif (linear), or .film (for merge). By default\n"
                 "the scene's name with .png, in the current folder")
      ->type_name("FILE");
  CLI::Option* const spp = app.add_option("--spp", arguments.samples, "Samples per pixel")
                               ->check(whole_number(1, 1 << 30))
                               ->type_name("N");
  app.add_option_function<std::string>(
         "--samples",
         [&arguments](const std::string& text) {
           arguments.sample_range = parse_range(text);
           if (!arguments.sample_range)
             throw CLI::ValidationError("--samples", text +
                                                         " is not FROM:TO with 0 <= FROM < TO <= "
                                                         "2^30; use --spp for a number of samples");
         },
         "Render only the samples FROM <= i < TO of each pixel,\n"
         "to a .film file for merge")
      ->excludes(spp)
      ->type_name("FROM:TO");
  app.add_option_function<std::string>(
         "--frames",
         [&arguments](const std::string& text) {
           arguments.frames = parse_frames(text);
           if (!arguments.frames)
             throw CLI::ValidationError(
                 "--frames", text + " is neither A:B with 0 <= A < B <= 2^30 nor a frame number");
         },
         "Render the frames A <= i < B of an animation, or one\n"
         "frame. #### in FILE becomes the frame number. Frames of\n"
         "this scene that are complete already are kept (.png,\n.exr, .film)")
      ->type_name("A:B");
  app.add_option("--width", arguments.width,
                 "Width of the picture in pixels; without --height, the\nheight follows the "
                 "scene's aspect ratio")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  app.add_option("--height", arguments.height,
                 "Height of the picture in pixels; without --width, the\nwidth follows")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  app.add_option_function<std::string>(
         "--crop",
         [&arguments](const std::string& text) {
           arguments.crop = parse_crop(text);
           if (!arguments.crop)
             throw CLI::ValidationError(
                 "--crop", text + " is not X0,X1,Y0,Y1 with 0 <= X0 < X1 and 0 <= Y0 < Y1");
         },
         "Render only the pixels with X0 <= x < X1 and\n"
         "Y0 <= y < Y1; y grows downwards")
      ->type_name("X0,X1,Y0,Y1");
  app.add_flag("--preview", arguments.preview,
               "Render a quarter of the width and height, with 4\nsamples unless --spp is given");
  app.add_option("--threads", arguments.threads, "Number of threads; 0, the default: one per core")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  app.add_option("--seed", arguments.seed, "Seed of the random numbers: another seed, other noise")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("N");
  app.add_option("--time-limit", arguments.time_limit,
                 "Stop after SECONDS in total and save the finished\nsamples")
      ->check(finite_number(0))
      ->type_name("SECONDS");
  app.add_option("--checkpoint", arguments.checkpoint,
                 "Save the state of the render to FILE.film every\nSECONDS; removed when the "
                 "picture is complete")
      ->check(finite_number(0))
      ->type_name("SECONDS");
  app.add_flag("--resume", arguments.resume,
               "Continue from FILE.film if it exists; the picture is\nthe same to the last bit");
  app.add_option("--write-every", arguments.write_every,
                 "Write the unfinished picture every SECONDS, as soon as\nevery pixel has a sample")
      ->check(finite_number(0))
      ->type_name("SECONDS");
  app.add_option_function<std::string>(
         "--tev",
         [&arguments](const std::string& text) {
           arguments.tev = parse_tev_address(text);
           if (!arguments.tev)
             throw CLI::ValidationError(
                 "--tev", text +
                              " is not HOST, HOST:PORT or PORT with 1 <= PORT <= 65535; an IPv6 "
                              "address is in brackets, [::1]:14158");
         },
         "Show the picture in the viewer tev while it renders;\ntev listens on 127.0.0.1:14158 by "
         "default")
      ->type_name("HOST:PORT");
  app.add_option("--exposure", arguments.exposure, "Exposure in stops, for .png and .jpg")
      ->check(finite_number(-std::numeric_limits<double>::infinity()))
      ->type_name("X");
  std::string accelerator_help =
      "The structure that answers rays. It changes the time,\nnever the picture. By default local "
      "if the scene\ndeclares influence areas, light if a grid pays, else\nbvh:";
  for (const AcceleratorName& choice : accelerator_names())
    accelerator_help += fmt::format("\n{:12} {}", choice.name, choice.description);
  app.add_option("--accel", arguments.accelerator, accelerator_help)
      ->check(accelerator_name())
      ->type_name("NAME");
  app.add_option("-D", arguments.overrides,
                 "Set a key of the scene: -D render.max_depth=3. May be\nrepeated")
      ->allow_extra_args(false)  // else -D would also take the SCENE that follows
      ->type_name("KEY=VALUE");
  app.add_option("--stats", arguments.stats, "Write times, rays, memory and error as JSON")
      ->type_name("FILE");
  app.add_flag("--half", arguments.half, "EXR: 16-bit floats instead of 32-bit");
  app.add_option("--png-bits", arguments.png_bits, "PNG: 8, the default, or 16 bits a channel")
      ->check(CLI::IsMember({8, 16}).description(""))
      ->type_name("N");
  app.add_flag("--quiet", arguments.quiet, "Print errors only");
  app.add_flag(
      "--strict", arguments.strict,
      "Treat warnings as errors: no picture if one is known\nbefore rendering; the exit code is 3");
  app.add_flag("--check", arguments.check, "Only load the scene and report its errors");
}

CLI::App* add_compare(CLI::App& app, CompareArguments& arguments) {
  CLI::App* compare =
      app.add_subcommand("compare", "Print how picture A differs from B, the reference");
  compare->add_option("A", arguments.a, "A picture")->required()->type_name("");
  compare->add_option("B", arguments.b, "The reference, of the same size")
      ->required()
      ->type_name("");
  compare->add_flag("--json", arguments.json, "Print JSON");
  compare
      ->add_option("--threshold", arguments.threshold, "Exit with 1 if any channel differs by more")
      ->check(finite_number(0))
      ->type_name("X");
  return compare;
}

CLI::App* add_merge(CLI::App& app, MergeArguments& arguments) {
  CLI::App* merge = app.add_subcommand(
      "merge", "Merge .film files of one picture, rendered with --samples or --crop");
  merge->get_formatter()->column_width(25);
  merge->add_option("PART", arguments.parts, ".film files, in any order")
      ->required()
      ->type_name("");
  merge
      ->add_option("-o,--output", arguments.output, "The picture, or a .film file to merge further")
      ->required()
      ->type_name("FILE");
  merge->add_option("--exposure", arguments.exposure, "Exposure in stops, for .png and .jpg")
      ->check(finite_number(-std::numeric_limits<double>::infinity()))
      ->type_name("X");
  return merge;
}

CLI::App* add_inspect(CLI::App& app, InspectArguments& arguments) {
  CLI::App* inspect = app.add_subcommand(
      "inspect", "Report the structure and cost of a scene's BVHs and light grids");
  inspect->get_formatter()->column_width(25);
  inspect->add_option("SCENE", arguments.scene, "A YAML file")->required()->type_name("");
  inspect
      ->add_option("-D", arguments.overrides,
                   "Set a key of the scene: -D film.width=64. May be\nrepeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  inspect->add_option("--width", arguments.width, "Number of camera rays in a row")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  inspect->add_option("--height", arguments.height, "Number of rows of camera rays")
      ->check(whole_number(1, 65536))
      ->type_name("N");
  inspect->add_flag("--all-areas", arguments.all_areas,
                    "Include derived areas that a render does not build");
  inspect->add_option("--json", arguments.json, "Write the report as JSON")->type_name("FILE");
  inspect
      ->add_option("--heatmap", arguments.heat_map,
                   "Write a picture of the cost of each pixel's ray:\n"
                   "nodes on the left, triangles on the right")
      ->type_name("FILE.png");
  inspect
      ->add_option("--structures", arguments.structures,
                   "Write a picture of which structure answers each\npixel's shadow rays")
      ->type_name("FILE.png");
  inspect
      ->add_option("--overlay", arguments.overlay,
                   "Write a picture of the scene with the influence areas\n"
                   "that are built and boxes drawn over it")
      ->type_name("FILE.png");
  inspect->add_option("--levels", arguments.levels, "How many levels of boxes --overlay draws")
      ->capture_default_str()
      ->check(whole_number(1, 80))
      ->type_name("N");
  return inspect;
}

CLI::App* add_study(CLI::App& app, StudyArguments& arguments) {
  CLI::App* study = app.add_subcommand(
      "study",
      "Measure how well heuristics predict and build local BVHs, and how fast accelerators are,\n"
      "over meshes and scenes");
  study->get_formatter()->column_width(25);
  study->add_option("FILE", arguments.files, "Mesh files and scenes")->required()->type_name("");
  study->add_option("-o,--output", arguments.output, "The folder to write report.md and tables to")
      ->required()
      ->type_name("DIR");
  study->add_flag("--quick", arguments.quick, "Fewer areas and rays: a first look");
  study
      ->add_option("--rays", arguments.rays,
                   "Rays for each area; by default 100000, or\n5000 with --quick")
      ->check(CLI::Range(1, 100'000'000).description(""))
      ->type_name("N");
  study->add_option("--seed", arguments.seed, "Seed of the rays; 1 by default")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("N");
  return study;
}

CLI::App* add_watch(CLI::App& app, RenderArguments& arguments) {
  CLI::App* watch = app.add_subcommand(
      "watch", "Render again whenever the scene or one of its files changes, until Ctrl-C");
  watch->get_formatter()->column_width(25);
  add_render_options(*watch, arguments);
  return watch;
}

// Throws UsageError for options before a subcommand, which would be ignored in silence.
void reject_render_options(const CLI::App& app, const CLI::App& subcommand) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0)
      throw UsageError(
          fmt::format("{} cannot be used with {}", option->get_name(), subcommand.get_name()));
}

// The option that a misspelled argument most likely meant.
std::string usage_hint(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> options;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view word =
        std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (word == "--csv") return "; inspect writes its report with --json";
    if (word == "--boxes" || word == "--areas")
      return "; inspect draws boxes and influence areas with --overlay";
    if (word == "render") return "; there is no command 'render': pahrender SCENE -o OUT";
    const bool known = std::find(options.begin(), options.end(), word) != options.end();
    if (word.starts_with("--") && !known) return suggestion(word, options);
  }
  return "";
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Renders a scene file to a picture: pahrender SCENE -o OUT", "pahrender");
  app.footer(
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 error in the scene or in a file\n"
      "that it names, 4 cannot read or write, 130 interrupted (what was rendered so far\n"
      "is saved; a second Ctrl-C stops at once).");
  app.set_version_flag("--version", "pahrender " PAHRENDER_VERSION);
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(25);
  RenderArguments render_arguments;
  CompareArguments compare_arguments;
  MergeArguments merge_arguments;
  InspectArguments inspect_arguments;
  StudyArguments study_arguments;
  RenderArguments watch_arguments;
  add_render_options(app, render_arguments);
  const CLI::App* compare = add_compare(app, compare_arguments);
  const CLI::App* merge = add_merge(app, merge_arguments);
  const CLI::App* inspect = add_inspect(app, inspect_arguments);
  const CLI::App* study = add_study(app, study_arguments);
  const CLI::App* watch = add_watch(app, watch_arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw UsageError(error.what() + usage_hint(app, argc, argv));
    app.exit(error);  // prints the help or the version
    return ExitCode::done;
  }
  if (compare->parsed()) {
    reject_render_options(app, *compare);
    return run_compare(compare_arguments);
  }
  if (merge->parsed()) {
    reject_render_options(app, *merge);
    return run_merge(merge_arguments);
  }
  if (inspect->parsed()) {
    reject_render_options(app, *inspect);
    return run_inspect(inspect_arguments);
  }
  if (study->parsed()) {
    reject_render_options(app, *study);
    return run_study(study_arguments);
  }
  if (watch->parsed()) {
    reject_render_options(app, *watch);
    if (watch_arguments.scene.empty())
      throw UsageError("no scene is given: pahrender watch SCENE -o OUT");
    return run_watch(watch_arguments);
  }
  if (render_arguments.scene.empty()) throw UsageError("no scene is given: pahrender SCENE -o OUT");
  return run_frames(render_arguments);
}

// If a standard stream is closed, the next file that is opened takes its number, and messages would
// be written into that file.
void hold_standard_streams() {
  for (int stream = 0; stream < 3; ++stream)
    if (::fcntl(stream, F_GETFD) == -1) (void)::open("/dev/null", O_RDONLY);
}

// If the system refuses to start a thread, oneTBB throws where no handler can catch it.
[[noreturn]] void end_without_catch() {
  const std::exception_ptr error = std::current_exception();
  if (!error) std::abort();
  constexpr int failed = static_cast<int>(ExitCode::failed);
  try {
    try {
      std::rethrow_exception(error);
    } catch (...) {
      report_exception();
    }
    say("There may be too little memory for so many threads; see --threads.\n");
  } catch (...) {
    ::_exit(failed);  // not even enough memory for a message
  }
  ::_exit(failed);
}

}  // namespace
}  // namespace pah::cli

int main(int argc, char** argv) {
  pah::cli::hold_standard_streams();
  pah::cli::outlive_failed_writes();
  std::set_terminate(pah::cli::end_without_catch);
  pah::cli::ExitCode code{};
  try {
    code = pah::cli::run(argc, argv);
  } catch (...) {
    code = pah::cli::report_exception();
  }
  return static_cast<int>(code);
}
