#include "support/paths.hpp"

namespace pah::test {

std::filesystem::path source_folder() { return PAH_SOURCE_DIR; }
std::filesystem::path build_folder() { return PAH_BINARY_DIR; }
std::filesystem::path program() { return build_folder() / "pahrender"; }

}  // namespace pah::test
