// The command `pahrender inspect SCENE`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Unset options keep the scene's values; files with an empty path are not written.
struct InspectArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // key.path=value
  std::optional<int> width, height;
  std::filesystem::path json;
  std::filesystem::path heat_map;    // .png
  std::filesystem::path structures;  // .png
  std::filesystem::path overlay;     // .png
  std::uint32_t levels = 8;          // of boxes in the overlay
  bool all_areas = false;            // also areas that a render does not build
};

// Throws UsageError, SceneError or FileError.
ExitCode run_inspect(const InspectArguments& arguments);

}  // namespace pah::cli
