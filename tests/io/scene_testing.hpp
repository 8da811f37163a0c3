// Scenes from text, for tests.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <pah/io/load_scene.hpp>
#include <string>
#include <string_view>
#include <vector>

// A folder of its own, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::path(PAH_BINARY_DIR) /
            ("scene_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline pah::LoadedScene load(std::string_view text, const pah::LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return pah::load_scene(folder.write("scene.yaml", text), options);
}

// All errors of a text, formatted without excerpts, one a line, the folder left out.
inline std::string errors_of(std::string_view text, const pah::LoadOptions& options = {}) {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.yaml", text);
  std::string result;
  try {
    (void)pah::load_scene(file, options);
  } catch (const pah::SceneError& error) {
    for (pah::LocatedError one : error.errors()) {
      one.excerpt.clear();
      if (one.where.file == file.string()) one.where.file = "scene.yaml";
      result += pah::format_error(one) + "\n";
    }
  }
  return result;
}
