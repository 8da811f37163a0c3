#pragma once

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Prints the exception that is being handled and returns its exit code.
ExitCode report_exception();

}  // namespace pah::cli
