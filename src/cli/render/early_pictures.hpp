// Writes the unfinished picture during a render.
#pragma once

#include <functional>
#include <pah/render/render.hpp>
#include <string>
#include <utility>

#include "base/stopwatch.hpp"
#include "cli/render/write_schedule.hpp"

namespace pah::cli {

class EarlyPictures {
 public:
  // Writes to a file; may throw.
  using Write = std::function<void(const Film&, const Progress&)>;
  using Warn = std::function<void(const std::string&)>;

  EarlyPictures(double interval, Write write, Warn warn)
      : schedule_(interval), write_(std::move(write)), warn_(std::move(warn)) {}

  // Writes if it is time to. Warns of the first failure only, and tries again at the next time: the
  // disk may have room by then.
  void show(const Film& film, const Progress& progress);

 private:
  void try_to_write(const Film& film, const Progress& progress);

  Stopwatch clock_;
  WriteSchedule schedule_;
  Write write_;
  Warn warn_;
  bool warned_ = false;
};

}  // namespace pah::cli
