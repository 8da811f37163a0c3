// Warnings of a render.
#pragma once

#include <pah/base/errors.hpp>
#include <string>
#include <vector>

namespace pah::cli {

// Prints warnings as they come and counts them. In strict mode they are called errors, and are
// printed also in quiet mode.
class Warnings {
 public:
  Warnings(bool quiet, bool strict) : quiet_(quiet), strict_(strict) {}

  void add(const std::string& warning);
  void add(const std::vector<std::string>& warnings);
  void add(const std::vector<LocatedError>& warnings);

  [[nodiscard]] int count() const { return count_; }
  // Returns whether there are warnings in strict mode.
  [[nodiscard]] bool failed() const { return strict_ && count_ > 0; }

 private:
  bool quiet_;
  bool strict_;
  int count_ = 0;
};

}  // namespace pah::cli
