// What is wrong with a picture without stopping it.
#pragma once

#include <pah/base/errors.hpp>
#include <string>
#include <vector>

namespace pah::cli {

// Says warnings as they come, and counts them. Where they are to be errors they are called so, and
// are said whatever else is not.
class Warnings {
 public:
  Warnings(bool quiet, bool strict) : quiet_(quiet), strict_(strict) {}

  void add(const std::string& warning);
  void add(const std::vector<std::string>& warnings);
  void add(const std::vector<LocatedError>& warnings);

  [[nodiscard]] int count() const { return count_; }
  // Whether they are errors, and there are some.
  [[nodiscard]] bool failed() const { return strict_ && count_ > 0; }

 private:
  bool quiet_;
  bool strict_;
  int count_ = 0;
};

}  // namespace pah::cli
