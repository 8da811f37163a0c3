// Loads scenes from text, for tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <pah/load/load_scene.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/temporary_folder.hpp"

inline std::filesystem::path write_text(const std::filesystem::path& file, std::string_view text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

inline pah::LoadedScene load(std::string_view text, const pah::LoadOptions& options = {}) {
  const pah::TemporaryFolder folder;
  return pah::load_scene(write_text(folder / "scene.yaml", text), options);
}

// Returns all errors of a scene file, one per line, without excerpts and without the folder.
inline std::string errors_in(const std::filesystem::path& file,
                             const pah::LoadOptions& options = {}) {
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

// Returns all errors of a scene's text.
inline std::string errors_of(std::string_view text, const pah::LoadOptions& options = {}) {
  const pah::TemporaryFolder folder;
  return errors_in(write_text(folder / "scene.yaml", text), options);
}
