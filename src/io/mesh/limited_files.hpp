// The importer's way to files.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pah {

// Gives out `main_bytes`, which have to outlive the import, for the main file, and files in or
// under one folder that are not too large. Those that are refused do not exist for it; the first is
// remembered.
class LimitedFiles : public Assimp::DefaultIOSystem {
 public:
  LimitedFiles(std::filesystem::path main, std::string_view main_bytes,
               std::filesystem::path folder, std::uint64_t max_bytes)
      : main_(std::move(main)),
        main_bytes_(main_bytes),
        folder_(std::move(folder)),
        max_bytes_(max_bytes) {}

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  // Why a file was refused, or empty.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  [[nodiscard]] bool is_main(const std::filesystem::path& file) const;
  [[nodiscard]] std::string reason_against(const std::filesystem::path& file) const;

  std::filesystem::path main_;
  std::string_view main_bytes_;
  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  mutable std::string refusal_;
};

}  // namespace pah
