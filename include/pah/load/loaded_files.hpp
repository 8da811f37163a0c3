// The contents of a scene's files, kept for the next load.
#pragma once

#include <memory>

namespace pah {

// Pass the same object to load_scene() again to skip the meshes and pictures that did not change
// since the last load, by size and time of modification. Meshes are held twice while a scene loads.
// One load at a time.
class LoadedFiles {
 public:
  LoadedFiles();
  ~LoadedFiles();
  LoadedFiles(LoadedFiles&& other) noexcept;
  LoadedFiles& operator=(LoadedFiles&& other) noexcept;

  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
