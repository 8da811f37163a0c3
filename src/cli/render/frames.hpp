// --frames: the pictures of an animation, one after the other.
#pragma once

#include "cli/render/render_command.hpp"

namespace pah::cli {

// The name with its last run of # as the frame's number, of at least as many digits.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& file, int frame);

// As run_render(), of every frame that arguments.frames asks for or, without, of the scene as it
// is. Ends with the first that is not done.
ExitCode run_frames(const RenderArguments& arguments, const RenderHooks& hooks = {});

}  // namespace pah::cli
