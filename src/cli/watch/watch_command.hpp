// The command `pahrender watch SCENE -o OUT`.
#pragma once

#include "cli/render/render_command.hpp"
#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Loads and renders the scene again whenever one of its files changes, until a signal. Throws
// UsageError if the first render does; prints other errors and waits for the next change.
ExitCode run_watch(const RenderArguments& arguments);

}  // namespace pah::cli
