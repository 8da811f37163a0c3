#include "load/mesh/obj/lines.hpp"

#include <algorithm>

#include "load/mesh/common/text.hpp"

namespace pah {
namespace {

bool begins_comment(std::string_view line) {
  const std::string_view word = Words(line).next();
  return !word.empty() && word.front() == '#';
}

}  // namespace

ObjStatement obj_statement(std::string_view keyword) {
  return keyword == "v"                      ? ObjStatement::position
         : keyword == "vt"                   ? ObjStatement::uv
         : keyword == "vn"                   ? ObjStatement::normal
         : keyword == "f" || keyword == "fo" ? ObjStatement::face
                                             : ObjStatement::other;
}

bool ObjLines::next() {
  if (left_.empty()) return false;
  ++number_;
  const std::size_t size = std::min(left_.find(line_end_), left_.size());
  std::string_view line = left_.substr(0, size);
  left_.remove_prefix(std::min(size + 1, left_.size()));
  if (number_ == 1) line = without_byte_order_mark(line);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  // A backslash joins the next line to the statement.
  const bool joins = !line.empty() && line.back() == '\\';
  if (joins) line.remove_suffix(1);
  begins_ = ends_;
  ends_ = !joins || (begins_ && begins_comment(line));
  text_ = line;
  return true;
}

}  // namespace pah
