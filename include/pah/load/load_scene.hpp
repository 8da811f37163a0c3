// Loads a scene file.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <pah/base/errors.hpp>
#include <pah/load/loaded_files.hpp>
#include <pah/scene/scene.hpp>
#include <string>
#include <vector>

namespace pah {

// Limits of a scene; exceeding one is a located error.
struct LoadLimits {
  std::uint64_t scene_bytes = 64ULL << 20;
  std::uint64_t yaml_nodes = 4'000'000;  // after alias expansion
  int nesting = 64;
  std::uint64_t mesh_file_bytes = 4ULL << 30;
  std::uint64_t triangles = 100'000'000;  // of the whole scene, copies included
  std::uint64_t instances = 20'000'000;
  std::uint64_t film_pixels = 1ULL << 28;
  std::uint64_t image_bytes = 4ULL << 30;  // of one decoded texture
};

struct LoadOptions {
  std::vector<std::string> overrides;  // "key.path=value", YAML values
  LoadLimits limits;
  // Called with each file that the scene names, directly or through another file, before it is
  // read, also if it does not exist.
  std::function<void(const std::filesystem::path&)> on_file = {};
  LoadedFiles* loaded = nullptr;  // files kept from the last load, for the next one
  std::optional<int> frame = {};  // of an animation; by default the scene's, or 0
};

struct LoadedScene {
  Scene scene;
  std::string hash;       // hex; covers the text, the overrides and every file that the scene names
  bool animated = false;  // the picture may depend on the frame
  std::vector<LocatedError> warnings;  // what the picture leaves out or shows differently
};

// Reads and checks a scene. Throws SceneError with every error found, FileError if the scene file
// itself cannot be read.
[[nodiscard]] LoadedScene load_scene(const std::filesystem::path& file,
                                     const LoadOptions& options = {});

}  // namespace pah
