// A piece of an OBJ file between two statements, which is read independently.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "load/mesh/common/polygon_mesh.hpp"
#include "load/mesh/common/text.hpp"
#include "load/mesh/obj/lines.hpp"

namespace pah {

// The order of arrays with an entry for each kind of element.
inline constexpr std::array<const char*, 3> obj_elements{"vertex position", "texture coordinate",
                                                         "normal"};
using ObjCounts = std::array<std::int64_t, 3>;

// The place where a piece begins: counts of everything before it.
struct ObjPlace {
  ObjCounts counts{};  // of elements
  std::uint64_t triangles = 0;
  int lines = 0;
  char line_end = '\n';
};

// Returns where the piece after `text` begins, except its triangles, if `text` has no error.
[[nodiscard]] ObjPlace place_behind(std::string_view text, const ObjPlace& place);

class ObjPiece {
 public:
  // The highest index of an element that a face used before the element was defined.
  struct Early {
    std::int64_t number = 0;
    int line = 0;
    int column = 0;
    std::string excerpt;
  };
  struct MaterialUse {
    std::size_t first_face;  // in the piece
    std::string_view name;   // in the text
  };
  struct Ignored {
    std::string keyword;
    int line;
  };

  // Throws MeshFileError, also if the file has more than `most_triangles` up to here.
  void read(std::string_view text, const ObjPlace& place, std::uint64_t most_triangles);

  std::vector<Vec3> positions;
  std::vector<Vec2> uvs;
  std::vector<Vec3> normals;
  std::vector<std::uint16_t> face_sizes;
  std::uint64_t triangles = 0;
  // The index of the element that each corner uses, from 0, or no_index.
  std::array<std::vector<std::uint32_t>, 3> corners;
  std::array<Early, 3> early;
  std::vector<MaterialUse> material_uses;
  std::vector<std::string_view> libraries;  // in the text
  std::vector<Ignored> ignored;             // the first few keywords

 private:
  void clear();
  [[noreturn]] void fail(const std::string& message, int column) const;
  void read_line(const ObjLines& line);
  void begin(Words& words);
  void end();
  void end_face();
  void need(std::size_t least) const;
  void number(const Words& words, std::string_view word);
  void corner(const Words& words, std::string_view word);
  [[noreturn]] void bad_corner(const Words& words, std::string_view word) const;
  // Resolves a number below 1, or above the count so far, to one from 1.
  [[nodiscard]] std::int64_t unusual_number(std::size_t element, std::int64_t number, int column);

  ObjCounts counts_{};  // so far
  std::uint64_t triangles_before_ = 0;
  std::uint64_t most_triangles_ = 0;
  ObjStatement statement_ = ObjStatement::other;
  std::size_t count_ = 0;  // numbers or corners of the statement so far
  float numbers_[3] = {};
  std::string_view text_;  // the current line
  int line_ = 0;
};

// Adds a keyword to `known` unless it is there or the list is full.
void add_ignored(std::vector<ObjPiece::Ignored>& known, std::string_view keyword, int line);

}  // namespace pah
