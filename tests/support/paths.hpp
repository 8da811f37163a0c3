// Paths that the build defines. They are compiled once, so that the objects of the tests are the
// same in every checkout.
#pragma once

#include <filesystem>

namespace pah::test {

[[nodiscard]] std::filesystem::path source_folder();
[[nodiscard]] std::filesystem::path build_folder();
[[nodiscard]] std::filesystem::path program();

}  // namespace pah::test
