// Cuts a text file into pieces that can be read independently.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "load/mesh/common/file_reader.hpp"

namespace pah {

// Pieces end after a line without a backslash at its end, so that no statement is cut.
class StatementText {
 public:
  // Pieces have about `piece_bytes`.
  StatementText(const std::filesystem::path& file, std::uint64_t max_bytes, std::size_t piece_bytes)
      : file_(file, max_bytes), piece_bytes_(piece_bytes) {}

  // Returns the next pieces of the file, at most `most`, and none at its end; valid until the next
  // call. Throws MeshFileError, with the line after the previous pieces, if a statement is
  // unreasonably long.
  [[nodiscard]] std::span<const std::string_view> next(std::size_t most, int lines_before);

  [[nodiscard]] char line_end() const { return file_.line_end(); }
  // The number of bytes after the pieces.
  [[nodiscard]] std::uint64_t left() const { return file_.left(); }

 private:
  FileReader file_;
  std::size_t piece_bytes_;
  std::vector<std::string_view> pieces_;
};

}  // namespace pah
