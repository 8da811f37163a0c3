#include "io/mesh/obj.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/mesh/file_reader.hpp"
#include "io/mesh/text.hpp"

namespace pah {
namespace {

// Positions, texture coordinates or normals: how many there are so far, the number that each corner
// uses, and the highest that one used before it was there.
struct Elements {
  const char* name;
  std::int64_t count = 0;
  std::vector<std::uint32_t> corners{};  // none as long as no corner uses any
  std::int64_t highest = 0;
  int line = 0;
  int column = 0;
  std::string excerpt{};
};

enum class Statement { other, position, uv, normal, face };

// Not drawn, or without a meaning for a picture.
constexpr std::string_view silent[] = {
    "o",      "g",      "s",     "l",        "p",        "vp",         "mg",        "lod",
    "usemap", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "end"};

bool begins_comment(std::string_view line) {
  const std::string_view word = Words(line).next();
  return !word.empty() && word.front() == '#';
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, const MeshFileOptions& options)
      : file_(file, options.file_bytes), max_triangles_(options.triangles) {
    result_.materials.emplace_back();
    materials_.emplace("", 0);
  }

  ObjFile read() {
    while (const auto line = file_.line()) read_line(*line);
    end();
    check_numbers();
    if (polygons_.face_sizes.empty()) throw MeshFileError("the file has no faces");
    make_vertices();
    for (const Ignored& ignored : ignored_)
      result_.warnings.push_back("'" + ignored.keyword + "', first in line " +
                                 std::to_string(ignored.line) + ", cannot be read and is left out");
    result_.polygons = std::move(polygons_);
    return std::move(result_);
  }

 private:
  struct Ignored {
    std::string keyword;
    int line;
  };

  [[noreturn]] void fail(const std::string& message, int column) const {
    throw MeshFileError(message, file_.line_number(), column, excerpt_of(text_));
  }

  void read_line(std::string_view line) {
    if (file_.line_number() == 1) line = without_byte_order_mark(line);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    // A backslash joins the next line to the statement.
    const bool joins = !line.empty() && line.back() == '\\';
    if (joins) line.remove_suffix(1);
    Words words(line);
    text_ = line;
    const bool comment = !open_ && begins_comment(line);
    if (!open_) begin(words);
    open_ = joins && !comment;
    if (statement_ != Statement::other) {
      for (std::string_view word = words.next(); !word.empty() && word.front() != '#';
           word = words.next()) {
        if (statement_ == Statement::face)
          corner(words, word);
        else
          number(words, word);
      }
    }
    if (!open_) end();
  }

  void begin(Words& words) {
    const std::string_view keyword = words.next();
    count_ = 0;
    statement_ = keyword == "v"                      ? Statement::position
                 : keyword == "vt"                   ? Statement::uv
                 : keyword == "vn"                   ? Statement::normal
                 : keyword == "f" || keyword == "fo" ? Statement::face
                                                     : Statement::other;
    if (statement_ != Statement::other || keyword.empty() || keyword.front() == '#') return;
    if (keyword == "usemtl")
      use_material(std::string(words.rest()));
    else if (keyword == "mtllib")
      result_.libraries.emplace_back(words.rest());
    else if (std::find(std::begin(silent), std::end(silent), keyword) == std::end(silent))
      ignore(keyword);
  }

  void ignore(std::string_view keyword) {
    constexpr std::size_t enough = 4;
    if (ignored_.size() >= enough) return;
    keyword = keyword.substr(0, 40);
    for (const Ignored& known : ignored_)
      if (known.keyword == excerpt_of(keyword)) return;
    ignored_.push_back({excerpt_of(keyword), file_.line_number()});
  }

  void use_material(const std::string& name) {
    const auto [entry, is_new] =
        materials_.emplace(name, static_cast<std::uint32_t>(result_.materials.size()));
    if (is_new) result_.materials.push_back(name);
    polygons_.runs.push_back({polygons_.face_sizes.size(), entry->second});
  }

  void end() {
    switch (statement_) {
      case Statement::position:
        need(3);
        polygons_.positions.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
        ++elements_[0].count;
        break;
      case Statement::uv:
        need(1);
        polygons_.uvs.emplace_back(numbers_[0], count_ > 1 ? numbers_[1] : 0);
        ++elements_[1].count;
        break;
      case Statement::normal:
        need(3);
        polygons_.normals.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
        ++elements_[2].count;
        break;
      case Statement::face:
        end_face();
        break;
      case Statement::other:
        break;
    }
    statement_ = Statement::other;
  }

  void need(std::size_t least) const {
    if (count_ >= least) return;
    fail(std::to_string(least) + (least == 1 ? " number is" : " numbers are") + " needed, " +
             std::to_string(count_) + " given",
         1);
  }

  void end_face() {
    if (count_ == 0) fail("a face without corners", 1);
    if (count_ < 3) {  // a point or a line
      const std::size_t before = elements_[0].corners.size() - count_;
      for (Elements& e : elements_) e.corners.resize(std::min(e.corners.size(), before));
      return;
    }
    polygons_.face_sizes.push_back(static_cast<std::uint16_t>(count_));
    triangles_ += count_ - 2;
    if (triangles_ > max_triangles_)
      fail("more than " + std::to_string(max_triangles_) + " triangles", 1);
  }

  void number(const Words& words, std::string_view word) {
    float value = 0;
    if (!read_float(word, value))
      fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number",
           words.column_of(word));
    // A weight or a color may follow.
    if (count_ < 3) numbers_[count_] = value;
    ++count_;
  }

  // i, i/j, i//k or i/j/k
  void corner(const Words& words, std::string_view word) {
    if (count_ == max_polygon_corners)
      fail("a face of more than " + std::to_string(max_polygon_corners) + " corners", 1);
    const char* at = word.data();
    const char* const last = at + word.size();
    for (Elements& e : elements_) {
      const bool first = &e == &elements_[0];
      bool given = first || at != last;
      if (!first && given) {
        if (*at++ != '/') bad_corner(words, word);
        given = at != last && *at != '/';
      }
      std::uint32_t index = no_index;
      if (given) {
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(at, last, number);
        if (error != std::errc{} || number == 0) bad_corner(words, word);
        at = end;
        index = index_of(e, number, words.column_of(word));
      }
      const std::size_t corners = elements_[0].corners.size();
      if (first || index != no_index || !e.corners.empty()) {
        if (!first) e.corners.resize(corners - 1, no_index);
        e.corners.push_back(index);
      }
    }
    if (at != last) bad_corner(words, word);
    ++count_;
  }

  // Numbers count from 1, or back from the last.
  std::uint32_t index_of(Elements& e, std::int64_t number, int column) {
    if (number < 0 && -number > e.count)
      fail(std::to_string(number) + " counts back beyond the first " + e.name, column);
    if (number < 0) number += e.count + 1;
    if (number > e.count && number > e.highest) {
      e.highest = number;
      e.line = file_.line_number();
      e.column = column;
      e.excerpt = excerpt_of(text_);
    }
    return static_cast<std::uint32_t>(std::min<std::int64_t>(number - 1, no_index - 1));
  }

  [[noreturn]] void bad_corner(const Words& words, std::string_view word) const {
    fail("'" + std::string(word.substr(0, 40)) + "' is not a corner of a face: numbers from 1 are",
         words.column_of(word));
  }

  void check_numbers() const {
    for (const Elements& e : elements_)
      if (e.highest > e.count)
        throw MeshFileError("the file has " + std::to_string(e.count) + " " + e.name +
                                (e.count == 1 ? "" : "s") + ", but a face uses number " +
                                std::to_string(e.highest),
                            e.line, e.column, e.excerpt);
  }

  // One vertex for each combination that corners use.
  void make_vertices() {
    auto& [positions, uvs, normals] = elements_;
    std::vector<std::uint32_t>& corners = positions.corners;
    const bool plain = uvs.corners.empty() && normals.corners.empty();
    if (plain) {
      polygons_.uvs = {};
      polygons_.normals = {};
      polygons_.corners = std::move(corners);
      return;
    }
    for (Elements* e : {&uvs, &normals})
      if (!e->corners.empty()) e->corners.resize(corners.size(), no_index);
    // Those of a position are a chain; one that is too long to search gets doubles, which do no
    // harm.
    constexpr int most_links = 16;
    std::vector<std::uint32_t> first(polygons_.positions.size(), no_index);
    std::vector<std::uint32_t> next;
    std::vector<PolygonVertex>& vertices = polygons_.vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const PolygonVertex wanted{corners[i], uvs.corners.empty() ? no_index : uvs.corners[i],
                                 normals.corners.empty() ? no_index : normals.corners[i]};
      std::uint32_t vertex = first[wanted.position];
      bool known = false;
      for (int links = 0; vertex != no_index && links < most_links && !known; ++links) {
        known = vertices[vertex].uv == wanted.uv && vertices[vertex].normal == wanted.normal;
        if (!known) vertex = next[vertex];
      }
      if (!known) {
        vertex = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(wanted);
        next.push_back(std::exchange(first[wanted.position], vertex));
      }
      corners[i] = vertex;
    }
    polygons_.corners = std::move(corners);
  }

  FileReader file_;
  std::uint64_t max_triangles_;
  std::uint64_t triangles_ = 0;
  PolygonMesh polygons_;
  ObjFile result_;
  std::unordered_map<std::string, std::uint32_t> materials_;
  std::vector<Ignored> ignored_;
  Elements elements_[3] = {{"vertex position"}, {"texture coordinate"}, {"normal"}};
  Statement statement_ = Statement::other;
  bool open_ = false;      // the next line belongs to this statement
  std::size_t count_ = 0;  // numbers or corners of the statement so far
  float numbers_[3] = {};
  std::string_view text_;  // the line at hand
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& file, const MeshFileOptions& options) {
  return ObjReader(file, options).read();
}

}  // namespace pah
