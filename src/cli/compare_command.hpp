// The command `pahrender compare A B`.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

struct CompareArguments {
  std::filesystem::path a, b;
  bool json = false;
  std::optional<double> threshold;  // that the largest difference must not exceed
};

// Throws FileError, and std::invalid_argument if the sizes differ.
ExitCode run_compare(const CompareArguments& arguments);

}  // namespace pah::cli
