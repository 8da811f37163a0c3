// Renders the frames of an animation one after the other (--frames).
#pragma once

#include "cli/render/render_command.hpp"

namespace pah::cli {

// Replaces the last run of # in a name by the frame's number, with at least as many digits.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& file, int frame);

// Calls run_render() for every frame of arguments.frames, or once without frames. Stops at the
// first exit code that is not `done`.
ExitCode run_frames(const RenderArguments& arguments, const RenderHooks& hooks = {});

}  // namespace pah::cli
