// The contents of LoadedFiles.
#pragma once

#include <pah/load/loaded_files.hpp>
#include <pah/load/mesh_file.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/file_stamp.hpp"

namespace pah {

using StampedFiles = std::vector<std::pair<std::filesystem::path, FileStamp>>;

// Values by name, each valid as long as the files that it comes from do not change.
template <class T>
class KeptValues {
 public:
  struct Entry {
    StampedFiles files;
    T value;
    bool used = true;  // since the last drop_unused()
  };

  // Returns null if there is no value or one of its files has changed.
  const Entry* find(const std::string& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    for (const auto& [file, stamp] : found->second.files)
      if (stamp_of(file) != stamp) return nullptr;
    found->second.used = true;
    return &found->second;
  }
  void put(const std::string& key, StampedFiles files, T value) {
    entries_.insert_or_assign(key, Entry{std::move(files), std::move(value)});
  }
  void drop_unused() {
    std::erase_if(entries_, [](const auto& entry) { return !entry.second.used; });
    for (auto& [key, entry] : entries_) entry.used = false;
  }

 private:
  std::unordered_map<std::string, Entry> entries_;
};

struct ReadMeshFile {
  MeshFile file;
  std::string content_hash;
};

struct LoadedFiles::Impl {
  KeptValues<ReadMeshFile> meshes;           // by path and options
  KeptValues<std::string> hashes;            // of content, by path
  KeptValues<std::uint64_t> picture_checks;  // numbers of unusable values, by path

  void drop_unused() {
    meshes.drop_unused();
    hashes.drop_unused();
    picture_checks.drop_unused();
  }
};

}  // namespace pah
