// The files that a scene names: their paths, checks that they can be read, and their hash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "load/scene/files/loaded_files.hpp"
#include "load/yaml/reader.hpp"

namespace pah {

// FNV-1a with 128 bits (Fowler, Noll, Vo; RFC 9923). Distinguishes scenes, but not against attacks.
class ContentHash {
 public:
  void add(std::string_view bytes);
  // Like add(), but eight bytes in a step: eight times as fast, with another hash.
  void add_words(std::string_view bytes);
  // Adds bytes with their length, so that neighboring parts stay apart.
  void add_part(std::string_view bytes);
  [[nodiscard]] std::string hex() const;

 private:
  void step(std::uint64_t bits);

  std::uint64_t high_ = 0x6C62272E07BB0142U;
  std::uint64_t low_ = 0x62B821756295C58DU;
};

class SceneFiles {
 public:
  using OnFile = std::function<void(const std::filesystem::path&)>;

  // Calls `on_file` with the full path of each file before accessing it. `loaded` may be null.
  explicit SceneFiles(std::filesystem::path folder, OnFile on_file = {},
                      LoadedFiles::Impl* loaded = nullptr)
      : folder_(std::move(folder)), on_file_(std::move(on_file)), loaded_(loaded) {}

  // Returns the path of the regular file that `node` names and, the first time, adds its content to
  // the hash. Reports an error and returns nothing if it cannot be read or is larger than
  // `most_bytes`.
  std::optional<std::filesystem::path> open(ReadContext& context, const YamlNode& node,
                                            const ValueName& name, std::uint64_t most_bytes);
  // The same for a file that another file names; the error is at the place that names the other
  // file.
  std::optional<std::filesystem::path> open(ReadContext& context, const Mark& mark,
                                            const std::filesystem::path& file,
                                            std::uint64_t most_bytes);

  // Calls on_file for a file that is read on behalf of another.
  void announce(const std::filesystem::path& file) const {
    if (on_file_) on_file_(file);
  }

  ContentHash& hash() { return hash_; }
  [[nodiscard]] LoadedFiles::Impl* loaded() const { return loaded_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  // Hashes the content of a file; returns nothing if it cannot be read to its end.
  [[nodiscard]] std::optional<std::string> content_hash(const std::filesystem::path& file,
                                                        std::uintmax_t size) const;

  OnFile on_file_;
  LoadedFiles::Impl* loaded_;
  ContentHash hash_;
  std::unordered_map<std::string, bool> seen_;  // full path: is it readable?
};

}  // namespace pah
