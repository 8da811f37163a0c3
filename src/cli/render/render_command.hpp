// pahrender SCENE -o OUT: the default command.
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

// What is not set stays as the scene says.
struct RenderArguments {
  std::filesystem::path scene;
  std::filesystem::path output;  // empty: the scene's name with .png, in the current folder
  std::optional<int> samples, width, height;
  std::optional<PixelRect> crop;
  bool preview = false;
  std::optional<std::uint64_t> seed;
  std::optional<double> exposure;
  int threads = 0;                         // 0: all
  double time_limit = 0;                   // seconds; 0: none
  std::optional<IndexRange> sample_range;  // of every pixel; none: all
  std::optional<double> checkpoint;        // seconds between writing what there is
  bool resume = false;                     // go on from it
  std::optional<double> write_every;       // seconds; 0: after every pass
  std::optional<TevAddress> tev;           // a viewer that shows the picture under way
  std::string accelerator;                 // empty: by the scene
  std::vector<std::string> overrides;      // key.path=value
  std::optional<IndexRange> frames;        // of an animation
  std::optional<int> frame;                // the one of them to render
  std::filesystem::path stats;             // empty: none
  bool half = false;                       // EXR files in 16-bit floats
  std::optional<int> png_bits;             // 8 or 16
  bool keep_whole = false;  // a picture that is there already, as it would be rendered
  bool quiet = false;
  bool strict = false;  // warnings are errors
  bool check = false;
};

// For those who render a scene more than once.
struct RenderHooks {
  std::function<void(const std::filesystem::path&)> on_file;  // as LoadOptions::on_file
  LoadedFiles* loaded = nullptr;                              // as LoadOptions::loaded
  const std::atomic<bool>* outdated = nullptr;  // once set, a render that was stopped is not saved
};

// One picture. Throws UsageError, SceneError or FileError.
ExitCode run_render(const RenderArguments& arguments, const RenderHooks& hooks = {});

}  // namespace pah::cli
