// Exit codes of the program.
#pragma once

#include <stdexcept>

namespace pah::cli {

enum class ExitCode {
  done = 0,
  failed = 1,
  wrong_usage = 2,
  scene_error = 3,
  file_error = 4,
  interrupted = 130,
};

// The command line is wrong.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pah::cli
