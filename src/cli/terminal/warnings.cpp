#include "cli/terminal/warnings.hpp"

#include "cli/terminal/console.hpp"

namespace pah::cli {

void Warnings::add(const std::string& warning) {
  ++count_;
  if (strict_) return say("error: " + warning + "\n");
  if (!quiet_) say("warning: " + warning + "\n");
}

void Warnings::add(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) add(warning);
}

void Warnings::add(const std::vector<LocatedError>& warnings) {
  for (const LocatedError& warning : warnings) {
    ++count_;
    if (strict_)
      say(format_error(warning) + "\n");
    else if (!quiet_)
      say(format_warning(warning) + "\n");
  }
}

}  // namespace pah::cli
