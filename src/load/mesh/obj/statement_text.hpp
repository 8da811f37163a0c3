// A text file in pieces that can be read each on its own.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "load/mesh/common/file_reader.hpp"

namespace pah {

// Pieces end behind lines whose last character is no backslash, so that no statement is cut.
class StatementText {
 public:
  // Pieces have about `piece_bytes`.
  StatementText(const std::filesystem::path& file, std::uint64_t max_bytes, std::size_t piece_bytes)
      : file_(file, max_bytes), piece_bytes_(piece_bytes) {}

  // The next pieces of the file, `most` or less; none at its end. Valid until the next call. Throws
  // MeshFileError if a statement is longer than any that makes sense, which is then in the line
  // behind the pieces before.
  [[nodiscard]] std::span<const std::string_view> next(std::size_t most, int lines_before);

  [[nodiscard]] char line_end() const { return file_.line_end(); }
  // Bytes behind the pieces.
  [[nodiscard]] std::uint64_t left() const { return file_.left(); }

 private:
  FileReader file_;
  std::size_t piece_bytes_;
  std::vector<std::string_view> pieces_;
};

}  // namespace pah
