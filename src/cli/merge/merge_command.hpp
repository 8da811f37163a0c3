// The command `pahrender merge PART... -o OUT`.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

struct MergeArguments {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
  std::optional<double> exposure;  // stops; by default that of the parts
};

// Throws FileError.
ExitCode run_merge(const MergeArguments& arguments);

}  // namespace pah::cli
