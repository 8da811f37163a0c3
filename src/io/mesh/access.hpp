// Which files a mesh file may name: those in or under one folder, and not too large.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

namespace pah {

// Whether `file` lies in or under `folder`, by its name alone: `..` is resolved, links are not.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

// The folder that limits a mesh file: `folder`, or the file's own if that is empty.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file,
                                              const std::filesystem::path& folder);

// assimp's way to files. Those that are refused do not exist for it; the first is remembered. A
// .mtl begins where its first material does: the importer does not survive properties of none.
class LimitedFiles : public Assimp::DefaultIOSystem {
 public:
  LimitedFiles(std::filesystem::path main, std::filesystem::path folder, std::uint64_t max_bytes)
      : main_(std::move(main)), folder_(std::move(folder)), max_bytes_(max_bytes) {}

  // What to give out for the main file; has to outlive the import.
  void replace_main(std::string_view bytes) { main_bytes_ = bytes; }

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  // Why a file was refused, or empty.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  [[nodiscard]] std::string reason_against(const std::filesystem::path& file) const;

  std::filesystem::path main_;
  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  std::string_view main_bytes_;
  std::deque<std::string> libraries_;  // texts of .mtl files given out
  mutable std::string refusal_;
};

}  // namespace pah
