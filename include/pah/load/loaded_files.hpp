// What the files of scenes hold, kept for the next load.
#pragma once

#include <memory>

namespace pah {

// Given to load_scene() again and again, it spares reading the meshes and checking the pictures
// that have not changed since the load before, by their sizes and times of modification. Meshes are
// held twice while a scene is loaded. One load at a time.
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
