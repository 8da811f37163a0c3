#include "cli/render/frames.hpp"

#include <fmt/format.h>

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

bool has_number(const fs::path& file) {
  return file.filename().string().find('#') != std::string::npos;
}

// Returns the output's name with #: each frame needs a file of its own.
fs::path pattern_of(const RenderArguments& arguments) {
  if (arguments.output.empty()) return arguments.scene.stem().string() + "_####.png";
  return arguments.output;
}

void require_number(const fs::path& file, const char* option, const IndexRange& frames) {
  if (file.empty() || has_number(file) || frames.to - frames.from == 1) return;
  const std::string with_number = file.stem().string() + "_####" + file.extension().string();
  throw UsageError(fmt::format("{} {} names one file for {} frames; name one for each frame: {}",
                               option, file.string(), frames.to - frames.from,
                               (file.parent_path() / with_number).string()));
}

}  // namespace

fs::path numbered(const fs::path& file, int frame) {
  std::string name = file.filename().string();
  const std::size_t last = name.rfind('#');
  if (last == std::string::npos) return file;
  const std::size_t before = name.find_last_not_of('#', last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  name.replace(first, last + 1 - first, fmt::format("{:0{}}", frame, last + 1 - first));
  return file.parent_path() / name;
}

ExitCode run_frames(const RenderArguments& arguments, const RenderHooks& hooks) {
  if (!arguments.frames) return run_render(arguments, hooks);
  const IndexRange& frames = *arguments.frames;
  const fs::path pattern = pattern_of(arguments);
  require_number(pattern, "-o", frames);
  require_number(arguments.stats, "--stats", frames);
  RenderArguments frame_arguments = arguments;
  frame_arguments.keep_whole = true;
  LoadedFiles loaded;
  RenderHooks frame_hooks = hooks;
  if (frame_hooks.loaded == nullptr) frame_hooks.loaded = &loaded;
  for (int frame = frames.from; frame < frames.to; ++frame) {
    frame_arguments.frame = frame;
    frame_arguments.output = numbered(pattern, frame);
    frame_arguments.stats = numbered(arguments.stats, frame);
    const ExitCode code = run_render(frame_arguments, frame_hooks);
    if (code != ExitCode::done) return code;
  }
  return ExitCode::done;
}

}  // namespace pah::cli
