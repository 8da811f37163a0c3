#include "io/mesh_file_scan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <pah/io/mesh_file.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pah {
namespace {

constexpr int max_corners = 10'000;

// An excerpt is a help to the eye, not a copy of the file.
std::string excerpt_of(std::string_view line) {
  std::string text(line.substr(0, 120));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}

  // The next word; empty at the end of the line.
  std::string_view next() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
    return line_.substr(begin, at_ - begin);
  }
  [[nodiscard]] int column_of(std::string_view word) const {
    return static_cast<int>(word.data() - line_.data()) + 1;
  }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

// Whether a float can hold the number that the word is; without parsing it where its length tells.
bool is_finite_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty()) return false;
  const bool plain = word.size() < 30 && std::all_of(word.begin(), word.end(), [](char c) {
                       return (c >= '0' && c <= '9') || c == '.' || c == '-';
                     });
  const bool starts_well = word.front() != '-' || word.size() > 1;
  if (plain && starts_well && word.find('-', 1) == std::string_view::npos &&
      word.find('.') == word.rfind('.') && word != "." && word != "-.")
    return true;
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) {
    // Too small is as good as 0; too large is not.
    const std::size_t e = word.find_first_of("eE");
    return e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
  }
  return error == std::errc{} && std::abs(value) <= 3.4028234e38;
}

// Positions, texture coordinates and normals: how many there are, and the highest that a face has
// asked for when it was not there yet.
struct Elements {
  const char* name;
  std::int64_t count = 0;
  std::int64_t highest = 0;
  int line = 0;
  int column = 0;
  std::string excerpt;
};

class ObjScan {
 public:
  explicit ObjScan(std::uint64_t max_triangles) : max_triangles_(max_triangles) {}

  void line(std::string_view text) {
    ++line_number_;
    // A backslash joins the next line; the parts are looked at as lines of one statement.
    const bool joined = joins_;
    joins_ = false;
    std::string_view rest = text;
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    if (!rest.empty() && rest.back() == '\\') {
      joins_ = true;
      rest.remove_suffix(1);
    }
    text_ = rest;
    Words words(rest);
    if (!joined) begin(words.next());
    if (statement_ == Statement::other) return;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (word.front() == '#') {
        // The importer takes it for a corner.
        if (statement_ == Statement::face)
          fail("a comment cannot follow a face's corners on their line", words.column_of(word));
        break;
      }
      if (statement_ == Statement::face)
        corner(words, word);
      else
        number(words, word);
    }
    if (!joins_) end();
  }

  void finish() {
    for (const Elements& e : elements_)
      if (e.highest > e.count)
        throw MeshFileError("the file has " + std::to_string(e.count) + " " + e.name +
                                (e.count == 1 ? "" : "s") + ", but a face uses number " +
                                std::to_string(e.highest),
                            e.line, e.column, e.excerpt);
    if (triangles_ == 0) throw MeshFileError("the file has no faces");
  }

 private:
  enum class Statement { other, position, uv, normal, face };

  [[noreturn]] void fail(const std::string& message, int column) const {
    throw MeshFileError(message, line_number_, column, excerpt_of(text_));
  }

  void begin(std::string_view keyword) {
    statement_ = keyword == "v"    ? Statement::position
                 : keyword == "vt" ? Statement::uv
                 : keyword == "vn" ? Statement::normal
                 : keyword == "f"  ? Statement::face
                                   : Statement::other;
    count_ = 0;
    if (statement_ == Statement::position) ++elements_[0].count;
    if (statement_ == Statement::uv) ++elements_[1].count;
    if (statement_ == Statement::normal) ++elements_[2].count;
  }

  void end() {
    const int least = statement_ == Statement::uv ? 1 : 3;
    if (statement_ == Statement::face) {
      // Faces of one or two corners are points and lines: not drawn, but allowed.
      if (count_ == 0) fail("a face without corners", 1);
      if (count_ > max_corners)
        fail("a face of more than " + std::to_string(max_corners) + " corners", 1);
      triangles_ += static_cast<std::uint64_t>(std::max(count_ - 2, 0));
      if (triangles_ > max_triangles_)
        fail("more than " + std::to_string(max_triangles_) + " triangles", 1);
    } else if (count_ < least) {
      fail(std::to_string(least) + (least == 1 ? " number is" : " numbers are") + " needed, " +
               std::to_string(count_) + " given",
           1);
    }
  }

  void number(const Words& words, std::string_view word) {
    if (!is_finite_number(word))
      fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number",
           words.column_of(word));
    ++count_;
  }

  // i, i/j, i//k or i/j/k
  void corner(const Words& words, std::string_view word) {
    const char* at = word.data();
    const char* const last = at + word.size();
    for (Elements& e : elements_) {
      if (at != word.data()) {
        if (at == last) break;
        if (*at++ != '/') bad_corner(words, word);
        if (&e != &elements_[0] && (at == last || *at == '/')) continue;
      }
      std::int64_t index = 0;
      const auto [end, error] = std::from_chars(at, last, index);
      if (error != std::errc{} || index == 0) bad_corner(words, word);
      at = end;
      if (index < 0 && -index > e.count)
        fail(std::to_string(index) + " counts back beyond the first " + e.name,
             words.column_of(word));
      if (index > e.count && index > e.highest) {
        e.highest = index;
        e.line = line_number_;
        e.column = words.column_of(word);
        e.excerpt = excerpt_of(text_);
      }
    }
    if (at != last) bad_corner(words, word);
    ++count_;
  }

  [[noreturn]] void bad_corner(const Words& words, std::string_view word) const {
    fail("'" + std::string(word.substr(0, 40)) + "' is not a corner of a face: numbers from 1 are",
         words.column_of(word));
  }

  std::uint64_t max_triangles_;
  std::uint64_t triangles_ = 0;
  Elements elements_[3] = {{"vertex position", 0, 0, 0, 0, {}},
                           {"texture coordinate", 0, 0, 0, 0, {}},
                           {"normal", 0, 0, 0, 0, {}}};
  Statement statement_ = Statement::other;
  int line_number_ = 0;
  int count_ = 0;  // numbers or corners of this statement
  bool joins_ = false;
  std::string_view text_;
};

// Calls visit(line) for every line, without its end; holds no more than a line and a block.
template <class Visit>
void for_each_line(const std::filesystem::path& file, const Visit& visit) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw MeshFileError("the file cannot be read");
  constexpr std::size_t block = 1U << 20;
  std::vector<char> buffer;
  std::size_t held = 0;  // bytes of an unfinished line
  while (stream) {
    buffer.resize(held + block);
    stream.read(buffer.data() + held, block);
    const std::size_t end = held + static_cast<std::size_t>(stream.gcount());
    std::size_t begin = 0;
    while (const void* found = std::memchr(buffer.data() + begin, '\n', end - begin)) {
      const auto stop = static_cast<std::size_t>(static_cast<const char*>(found) - buffer.data());
      visit(std::string_view(buffer.data() + begin, stop - begin));
      begin = stop + 1;
    }
    held = end - begin;
    std::memmove(buffer.data(), buffer.data() + begin, held);
  }
  if (held > 0) visit(std::string_view(buffer.data(), held));
}

}  // namespace

void scan_obj(const std::filesystem::path& file, std::uint64_t max_triangles) {
  ObjScan scan(max_triangles);
  for_each_line(file, [&](std::string_view line) { scan.line(line); });
  scan.finish();
}

void scan_ply_header(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  for (int number = 1; number < 1000 && std::getline(stream, line); ++number) {
    Words words(line);
    const std::string_view first = words.next();
    if (number == 1 && first != "ply") throw MeshFileError("a PLY file starts with 'ply'", 1, 1);
    if (first == "end_header") return;
    if (first != "element") continue;
    (void)words.next();
    const std::string_view word = words.next();
    std::uint64_t count = 0;
    const auto [end, wrong] = std::from_chars(word.data(), word.data() + word.size(), count);
    // Every element takes at least a byte.
    if (wrong != std::errc{} || end != word.data() + word.size() || count > bytes)
      throw MeshFileError("the file is too short for '" + excerpt_of(line) + "'", number,
                          words.column_of(word), excerpt_of(line));
  }
  throw MeshFileError("the header does not end");
}

}  // namespace pah
