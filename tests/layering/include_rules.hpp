// Who may include whom: the order of modules and of the floors within them, and where third parties
// may be seen.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pah::test {

// One line for every #include below root/include/pah and root/src that breaks a rule, sorted:
// "src/bvh/sah.cpp:3: bvh must not include accel".
[[nodiscard]] std::vector<std::string> broken_include_rules(const std::filesystem::path& root);

}  // namespace pah::test
