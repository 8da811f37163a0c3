#include "cli/render/render_command.hpp"

#include "cli/render/render_job.hpp"
#include "cli/terminal/interrupt.hpp"

namespace pah::cli {

ExitCode run_render(const RenderArguments& arguments, const RenderHooks& hooks) {
  handle_interrupts();
  RenderJob job(arguments, hooks);
  if (const std::optional<ExitCode> code = job.load()) return *code;
  if (const std::optional<ExitCode> code = job.build()) return *code;
  job.trace();
  return job.save();
}

}  // namespace pah::cli
