// Which files a mesh file may name: those in or under one folder, and not too large.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace pah {

// Whether `file` lies in or under `folder`, by its name alone: `..` is resolved, links are not.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

// The folder that limits a mesh file: `folder`, or the file's own if that is empty.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file,
                                              const std::filesystem::path& folder);

// assimp's way to files. Those that are refused do not exist for it; the first is remembered.
class LimitedFiles : public Assimp::DefaultIOSystem {
 public:
  LimitedFiles(std::filesystem::path main, std::filesystem::path folder, std::uint64_t max_bytes)
      : main_(std::move(main)), folder_(std::move(folder)), max_bytes_(max_bytes) {}

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  // Why a file was refused, or empty.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  [[nodiscard]] std::string reason_against(const std::filesystem::path& file) const;

  std::filesystem::path main_;
  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  mutable std::string refusal_;
};

}  // namespace pah
