// Places that only the build knows. Compiled once, so that the tests' own objects are the same in
// every checkout.
#pragma once

#include <filesystem>

namespace pah::test {

[[nodiscard]] std::filesystem::path source_folder();
[[nodiscard]] std::filesystem::path build_folder();
[[nodiscard]] std::filesystem::path program();

}  // namespace pah::test
