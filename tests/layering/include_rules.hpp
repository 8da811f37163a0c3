// The rules of includes: the order of modules, the order of floors within them, and the files that
// may include third-party headers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pah::test {

// Returns a line for every #include below root/include/pah and root/src that breaks a rule, sorted:
// "src/bvh/sah.cpp:3: bvh must not include accel".
[[nodiscard]] std::vector<std::string> broken_include_rules(const std::filesystem::path& root);

}  // namespace pah::test
