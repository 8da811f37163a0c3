#include "load/mesh/obj/piece.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

#include "load/mesh/common/text.hpp"

namespace pah {
namespace {

// Statements that are not drawn, or have no effect on a picture.
constexpr std::string_view ignored_keywords[] = {
    "o",      "g",      "s",     "l",        "p",        "vp",         "mg",        "lod",
    "usemap", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "end"};

// Like std::from_chars(), but faster for short numbers without a sign, which are most.
std::from_chars_result read_whole(const char* at, const char* last, std::int64_t& number) {
  constexpr std::ptrdiff_t most_digits = 9;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const char* const enough = at + std::min(last - at, most_digits);
  std::uint32_t value = 0;
  const char* digit = at;
  for (; digit < enough && is_digit(*digit); ++digit)
    value = 10 * value + static_cast<std::uint32_t>(*digit - '0');
  if (digit == at || (digit < last && is_digit(*digit))) return std::from_chars(at, last, number);
  number = value;
  return {digit, std::errc{}};
}

}  // namespace

ObjPlace place_behind(std::string_view text, const ObjPlace& place) {
  ObjPlace behind = place;
  const auto count = [&](std::string_view line) {
    const auto element = static_cast<std::size_t>(obj_statement(Words(line).next())) -
                         static_cast<std::size_t>(ObjStatement::position);
    if (element < behind.counts.size()) ++behind.counts[element];
  };
  // Without a backslash, each line is a statement.
  if (place.lines > 0 && text.find('\\') == std::string_view::npos) {
    while (!text.empty()) {
      const std::size_t size = std::min(text.find(place.line_end), text.size());
      if (size > 0 && text.front() != 'f') count(text.substr(0, size));
      text.remove_prefix(std::min(size + 1, text.size()));
      ++behind.lines;
    }
    return behind;
  }
  ObjLines lines(text, place.line_end, place.lines);
  while (lines.next())
    if (lines.begins()) count(lines.text());
  behind.lines = lines.number();
  return behind;
}

void add_ignored(std::vector<ObjPiece::Ignored>& known, std::string_view keyword, int line) {
  constexpr std::size_t enough = 4;
  if (known.size() >= enough) return;
  const std::string name = excerpt_of(keyword.substr(0, 40));
  for (const ObjPiece::Ignored& other : known)
    if (other.keyword == name) return;
  known.push_back({name, line});
}

void ObjPiece::read(std::string_view text, const ObjPlace& place, std::uint64_t most_triangles) {
  clear();
  counts_ = place.counts;
  triangles_before_ = place.triangles;
  most_triangles_ = most_triangles;
  ObjLines lines(text, place.line_end, place.lines);
  while (lines.next()) read_line(lines);
  end();
}

void ObjPiece::clear() {
  positions.clear();
  uvs.clear();
  normals.clear();
  face_sizes.clear();
  for (auto& numbers : corners) numbers.clear();
  triangles = 0;
  early = {};
  material_uses.clear();
  libraries.clear();
  ignored.clear();
  statement_ = ObjStatement::other;
}

void ObjPiece::fail(const std::string& message, int column) const {
  throw MeshFileError(message, line_, column, excerpt_of(text_));
}

void ObjPiece::read_line(const ObjLines& line) {
  text_ = line.text();
  line_ = line.number();
  Words words(text_);
  if (line.begins()) begin(words);
  if (statement_ != ObjStatement::other) {
    for (std::string_view word = words.next(); !word.empty() && word.front() != '#';
         word = words.next()) {
      if (statement_ == ObjStatement::face)
        corner(words, word);
      else
        number(words, word);
    }
  }
  if (line.ends()) end();
}

void ObjPiece::begin(Words& words) {
  const std::string_view keyword = words.next();
  count_ = 0;
  statement_ = obj_statement(keyword);
  if (statement_ != ObjStatement::other || keyword.empty() || keyword.front() == '#') return;
  if (keyword == "usemtl")
    material_uses.push_back({face_sizes.size(), words.rest()});
  else if (keyword == "mtllib")
    libraries.push_back(words.rest());
  else if (std::find(std::begin(ignored_keywords), std::end(ignored_keywords), keyword) ==
           std::end(ignored_keywords))
    add_ignored(ignored, keyword, line_);
}

void ObjPiece::end() {
  switch (statement_) {
    case ObjStatement::position:
      need(3);
      positions.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
      ++counts_[0];
      break;
    case ObjStatement::uv:
      need(1);
      uvs.emplace_back(numbers_[0], count_ > 1 ? numbers_[1] : 0);
      ++counts_[1];
      break;
    case ObjStatement::normal:
      need(3);
      normals.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
      ++counts_[2];
      break;
    case ObjStatement::face:
      end_face();
      break;
    case ObjStatement::other:
      break;
  }
  statement_ = ObjStatement::other;
}

void ObjPiece::need(std::size_t least) const {
  if (count_ >= least) return;
  fail(std::to_string(least) + (least == 1 ? " number is" : " numbers are") + " needed, " +
           std::to_string(count_) + " given",
       1);
}

void ObjPiece::end_face() {
  if (count_ == 0) fail("a face without corners", 1);
  if (count_ < 3) {  // a point or a line
    for (auto& numbers : corners) numbers.resize(numbers.size() - count_);
    return;
  }
  face_sizes.push_back(static_cast<std::uint16_t>(count_));
  triangles += count_ - 2;
  if (triangles_before_ + triangles > most_triangles_)
    fail("more than " + std::to_string(most_triangles_) + " triangles", 1);
}

void ObjPiece::number(const Words& words, std::string_view word) {
  float value = 0;
  if (!read_float(word, value))
    fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number", words.column_of(word));
  // A weight or a color may follow.
  if (count_ < 3) numbers_[count_] = value;
  ++count_;
}

// i, i/j, i//k or i/j/k
void ObjPiece::corner(const Words& words, std::string_view word) {
  if (count_ == max_polygon_corners)
    fail("a face of more than " + std::to_string(max_polygon_corners) + " corners", 1);
  const char* at = word.data();
  const char* const last = at + word.size();
  for (std::size_t element = 0; element < corners.size(); ++element) {
    bool given = element == 0 || at != last;
    if (element > 0 && given) {
      if (*at++ != '/') bad_corner(words, word);
      given = at != last && *at != '/';
    }
    std::uint32_t index = no_index;
    if (given) {
      std::int64_t number = 0;
      const auto [end, error] = read_whole(at, last, number);
      if (error != std::errc{} || number == 0) bad_corner(words, word);
      at = end;
      if (number < 0 || number > counts_[element])
        number = unusual_number(element, number, words.column_of(word));
      index = static_cast<std::uint32_t>(std::min<std::int64_t>(number - 1, no_index - 1));
    }
    corners[element].push_back(index);
  }
  if (at != last) bad_corner(words, word);
  ++count_;
}

// Indices count from 1, or back from the last element.
std::int64_t ObjPiece::unusual_number(std::size_t element, std::int64_t number, int column) {
  const std::int64_t count = counts_[element];
  if (number < 0 && number < -count)
    fail(std::to_string(number) + " counts back beyond the first " + obj_elements[element], column);
  if (number < 0) return number + count + 1;
  Early& highest = early[element];
  if (number > highest.number) highest = {number, line_, column, excerpt_of(text_)};
  return number;
}

void ObjPiece::bad_corner(const Words& words, std::string_view word) const {
  fail("'" + std::string(word.substr(0, 40)) + "' is not a corner of a face: numbers from 1 are",
       words.column_of(word));
}

}  // namespace pah
