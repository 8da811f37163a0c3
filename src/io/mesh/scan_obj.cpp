#include "io/mesh/scan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <pah/io/mesh_file.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/text.hpp"

namespace pah {
namespace {

constexpr int max_corners = 10'000;

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

}  // namespace pah
