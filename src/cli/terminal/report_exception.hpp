#pragma once

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Says what the exception that is being handled means.
ExitCode report_exception();

}  // namespace pah::cli
