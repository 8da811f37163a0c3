#include "load/mesh/obj/statement_text.hpp"

#include <algorithm>
#include <pah/load/mesh_file.hpp>

#include "load/mesh/common/text.hpp"

namespace pah {
namespace {

// Returns the position after the first line end from `from` on that does not split a statement; 0
// if there is none.
std::size_t find_cut(std::string_view text, std::size_t from, char line_end) {
  for (std::size_t at = from; (at = text.find(line_end, at)) != std::string_view::npos; ++at) {
    std::size_t last = at;
    while (last > 0 && is_blank(text[last - 1]) && text[last - 1] != line_end) --last;
    if (last == 0 || text[last - 1] != '\\') return at + 1;
  }
  return 0;
}

// Returns the position after the last such line end; 0 if there is none.
std::size_t find_last_cut(std::string_view text, char line_end) {
  std::size_t last = 0;
  for (std::size_t cut = 0; (cut = find_cut(text, cut, line_end)) != 0;) last = cut;
  return last;
}

}  // namespace

std::span<const std::string_view> StatementText::next(std::size_t most, int lines_before) {
  pieces_.clear();
  for (std::size_t wanted = most * piece_bytes_;; wanted *= 2) {
    std::string_view text = file_.ahead(wanted);
    const bool at_end = text.size() == file_.left();
    std::size_t used = 0;
    while (!text.empty() && pieces_.size() < most) {
      std::size_t size =
          text.size() < piece_bytes_ ? 0 : find_cut(text, piece_bytes_ - 1, line_end());
      if (size == 0 && at_end) size = text.size();
      if (size == 0) break;
      pieces_.push_back(text.substr(0, size));
      text.remove_prefix(size);
      used += size;
    }
    const bool too_long = pieces_.empty() && text.size() > longest_line;
    // Reads the statements before an endless line first.
    if (too_long && !at_end) used = find_last_cut(text, line_end());
    if (pieces_.empty() && used > 0) pieces_.push_back(text.substr(0, used));
    if (!pieces_.empty() || at_end) {
      file_.skip(used);
      return pieces_;
    }
    if (too_long) {
      const bool one_line = text.find(line_end()) == std::string_view::npos;
      throw MeshFileError(std::string(one_line ? "a line" : "a statement") + " of more than " +
                              std::to_string(longest_line >> 20) + " MB",
                          lines_before + 1);
    }
  }
}

}  // namespace pah
