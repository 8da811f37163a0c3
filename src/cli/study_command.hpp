// The command `pahrender study FILE... -o DIR`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

struct StudyArguments {
  std::vector<std::filesystem::path> files;  // meshes and scenes
  std::filesystem::path output;              // a folder, created if it is missing
  bool quick = false;
  std::uint64_t rays = 0;  // per area; 0: the default
  std::uint64_t seed = 1;
};

// Throws SceneError for errors in files, FileError for files that cannot be read or written.
ExitCode run_study(const StudyArguments& arguments);

}  // namespace pah::cli
