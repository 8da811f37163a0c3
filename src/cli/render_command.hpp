// pahrender SCENE -o OUT: the default command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <pah/scene/settings.hpp>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pah::cli {

// What is not set stays as the scene says.
struct RenderArguments {
  std::filesystem::path scene;
  std::filesystem::path output;  // empty: the scene's name with .png, in the current folder
  std::optional<int> samples, width, height;
  std::optional<PixelRect> crop;
  bool preview = false;
  std::optional<std::uint64_t> seed;
  std::optional<double> exposure;
  int threads = 0;                     // 0: all
  double time_limit = 0;               // seconds; 0: none
  std::optional<double> write_every;   // seconds; 0: after every pass
  std::string accelerator;             // empty: by the scene
  std::vector<std::string> overrides;  // key.path=value
  std::filesystem::path stats;         // empty: none
  bool half = false;                   // EXR files in 16-bit floats
  std::optional<int> png_bits;         // 8 or 16
  bool quiet = false;
  bool strict = false;  // warnings are errors
  bool check = false;
};

// Throws UsageError, SceneError or FileError.
ExitCode run_render(const RenderArguments& arguments);

}  // namespace pah::cli
