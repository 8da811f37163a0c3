// pahrender watch SCENE -o OUT
#pragma once

#include "cli/render/render_command.hpp"
#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Renders anew, everything loaded again, whenever the scene or a file that it names changes, until
// a signal ends it. Throws UsageError if the first render does; other errors are said, and a change
// is waited for.
ExitCode run_watch(const RenderArguments& arguments);

}  // namespace pah::cli
