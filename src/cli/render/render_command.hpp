// The default command: `pahrender SCENE -o OUT`.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <pah/load/loaded_files.hpp>
#include <pah/scene/settings.hpp>
#include <string>
#include <vector>

#include "cli/terminal/exit_code.hpp"
#include "cli/tev/address.hpp"

namespace pah::cli {

struct IndexRange {
  int from = 0, to = 0;  // [from, to)
};

// Unset options keep the scene's values.
struct RenderArguments {
  std::filesystem::path scene;
  std::filesystem::path output;  // empty: the scene's name with .png, in the current folder
  std::optional<int> samples, width, height;
  std::optional<PixelRect> crop;
  bool preview = false;
  std::optional<std::uint64_t> seed;
  std::optional<double> exposure;
  int threads = 0;                         // 0: one per core
  double time_limit = 0;                   // seconds; 0: none
  std::optional<IndexRange> sample_range;  // of every pixel; by default all
  std::optional<double> checkpoint;        // seconds between saves
  bool resume = false;                     // continue from the checkpoint
  std::optional<double> write_every;       // seconds; 0: after every pass
  std::optional<TevAddress> tev;           // a viewer that shows the running render
  std::string accelerator;                 // empty: chosen by the scene
  std::vector<std::string> overrides;      // key.path=value
  std::optional<IndexRange> frames;        // of an animation
  std::optional<int> frame;                // the frame to render
  std::filesystem::path stats;             // empty: none
  bool half = false;                       // EXR files in 16-bit floats
  std::optional<int> png_bits;             // 8 or 16
  bool keep_whole = false;  // keep an existing picture if it is complete and has the same settings
  bool quiet = false;
  bool strict = false;  // warnings are errors
  bool check = false;
};

// Hooks for callers that render a scene more than once.
struct RenderHooks {
  std::function<void(const std::filesystem::path&)> on_file;  // as LoadOptions::on_file
  LoadedFiles* loaded = nullptr;                              // as LoadOptions::loaded
  const std::atomic<bool>* outdated = nullptr;  // if set, a stopped render is not saved
};

// Renders one picture. Throws UsageError, SceneError or FileError.
ExitCode run_render(const RenderArguments& arguments, const RenderHooks& hooks = {});

}  // namespace pah::cli
