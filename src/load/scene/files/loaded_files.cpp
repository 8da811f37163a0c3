#include "load/scene/files/loaded_files.hpp"

namespace pah {

LoadedFiles::LoadedFiles() : impl_(std::make_unique<Impl>()) {}
LoadedFiles::~LoadedFiles() = default;
LoadedFiles::LoadedFiles(LoadedFiles&& other) noexcept = default;
LoadedFiles& LoadedFiles::operator=(LoadedFiles&& other) noexcept = default;

}  // namespace pah
