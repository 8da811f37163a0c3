#include "load/mesh/obj/obj.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/parallel_for.hpp"
#include "load/mesh/obj/piece.hpp"
#include "load/mesh/obj/statement_text.hpp"

namespace pah {
namespace {

// The index of the texture coordinate or normal of each corner. Stored only if any differs from the
// index of the corner's position.
class CornerNumbers {
 public:
  // `positions` belong to the corners before the piece.
  void add(const ObjPiece& piece, std::size_t element, std::span<const std::uint32_t> positions) {
    const std::vector<std::uint32_t>& numbers = piece.corners[element];
    if (numbers.empty()) return;
    const Kind kind = kind_of(numbers, piece.corners[0]);
    if (positions.empty()) kind_ = kind;
    if (kind == kind_ && kind != Kind::own) return;
    if (kind_ == Kind::none) numbers_.assign(positions.size(), no_index);
    if (kind_ == Kind::as_position) numbers_.assign(positions.begin(), positions.end());
    kind_ = Kind::own;
    numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  }

  [[nodiscard]] bool own() const { return kind_ == Kind::own; }
  [[nodiscard]] bool none() const { return kind_ == Kind::none; }
  [[nodiscard]] std::uint32_t at(std::size_t corner, std::uint32_t position) const {
    return own() ? numbers_[corner] : none() ? no_index : position;
  }

 private:
  enum class Kind { none, as_position, own };

  static Kind kind_of(const std::vector<std::uint32_t>& numbers,
                      const std::vector<std::uint32_t>& positions) {
    if (numbers == positions) return Kind::as_position;
    const bool none = std::all_of(numbers.begin(), numbers.end(),
                                  [](std::uint32_t number) { return number == no_index; });
    return none ? Kind::none : Kind::own;
  }

  Kind kind_ = Kind::none;
  std::vector<std::uint32_t> numbers_;
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, const MeshFileOptions& options,
            std::size_t piece_bytes)
      : text_(file, options.file_bytes, piece_bytes),
        pieces_left_(text_.left() / piece_bytes + 1),
        max_triangles_(options.triangles) {
    place_.line_end = text_.line_end();
    result_.materials.emplace_back();
    materials_.emplace("", 0);
  }

  ObjFile read() {
    // Several pieces for each thread, so that a slow piece does not leave threads idle.
    const std::size_t at_once = 4UL * parallel_threads();
    for (auto texts = text_.next(at_once, 0); !texts.empty();
         texts = text_.next(at_once, place_.lines))
      read(texts);
    check_numbers();
    if (polygons_.faces() == 0) throw MeshFileError("the file has no faces");
    make_vertices();
    for (const ObjPiece::Ignored& ignored : ignored_)
      result_.warnings.push_back("'" + ignored.keyword + "', first in line " +
                                 std::to_string(ignored.line) + ", cannot be read and is left out");
    result_.polygons = std::move(polygons_);
    return std::move(result_);
  }

 private:
  struct Slot {
    ObjPiece piece;
    ObjPlace place;  // where it begins
    bool failed = false;
  };

  void read(std::span<const std::string_view> texts) {
    if (slots_.size() < texts.size()) slots_.resize(texts.size());
    find_places(texts);
    parallel_for(texts.size(), 1, [&](std::size_t i) {
      Slot& slot = slots_[i];
      try {
        slot.place.triangles = place_.triangles;
        slot.piece.read(texts[i], slot.place, max_triangles_);
        slot.failed = false;
      } catch (const MeshFileError&) {
        slot.failed = true;
      }
    });
    for (std::size_t i = 0; i < texts.size(); ++i) {
      Slot& slot = slots_[i];
      slot.place.triangles = place_.triangles;
      // Reports the first error of the file. Triangles are counted only now, and there may be too
      // many before the error of the piece.
      if (slot.failed || place_.triangles + slot.piece.triangles > max_triangles_)
        slot.piece.read(texts[i], slot.place, max_triangles_);
      add(slot.piece);
      place_.triangles += slot.piece.triangles;
    }
  }

  void find_places(std::span<const std::string_view> texts) {
    // Only the first line of the file may have a byte order mark.
    const ObjPlace elsewhere{.lines = 1, .line_end = place_.line_end};
    parallel_for(texts.size(), 1, [&](std::size_t i) {
      slots_[i].place = place_behind(texts[i], i == 0 ? place_ : elsewhere);
    });
    ObjPlace next = place_;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const ObjPlace behind = std::exchange(slots_[i].place, next);
      if (i == 0) {
        next = behind;
        continue;
      }
      for (std::size_t e = 0; e < next.counts.size(); ++e) next.counts[e] += behind.counts[e];
      next.lines += behind.lines - elsewhere.lines;
    }
    place_ = next;
  }

  void add(const ObjPiece& piece) {
    pieces_left_ -= std::min<std::uint64_t>(pieces_left_, 1);
    for (const ObjPiece::MaterialUse& use : piece.material_uses) use_material(use);
    for (const std::size_t e : {1U, 2U}) numbers_[e - 1].add(piece, e, polygons_.all_corners());
    append<Vec3>(piece.positions, polygons_.positions);
    append<Vec2>(piece.uvs, polygons_.uvs);
    append<Vec3>(piece.normals, polygons_.normals);
    append_faces(piece);
    for (std::size_t e = 0; e < early_.size(); ++e)
      if (piece.early[e].number > early_[e].number) early_[e] = piece.early[e];
    result_.libraries.insert(result_.libraries.end(), piece.libraries.begin(),
                             piece.libraries.end());
    for (const ObjPiece::Ignored& ignored : piece.ignored)
      add_ignored(ignored_, ignored.keyword, ignored.line);
  }

  void append_faces(const ObjPiece& piece) {
    if (piece.face_sizes.size() == piece.triangles && polygons_.corners.empty()) {
      const auto* const triangles = reinterpret_cast<const UVec3*>(piece.corners[0].data());
      append<UVec3>({triangles, piece.face_sizes.size()}, polygons_.triangles);
      return;
    }
    if (!polygons_.triangles.empty()) {
      const std::span<const std::uint32_t> corners = polygons_.all_corners();
      polygons_.corners.assign(corners.begin(), corners.end());
      polygons_.face_sizes.assign(polygons_.triangles.size(), 3);
      polygons_.triangles = {};
    }
    append<std::uint16_t>(piece.face_sizes, polygons_.face_sizes);
    append<std::uint32_t>(piece.corners[0], polygons_.corners);
  }

  // Reserves room for as many from each remaining piece, because growing takes longer than reading.
  template <class T>
  void append(std::span<const T> from, std::vector<T>& to) const {
    if (to.capacity() < to.size() + from.size())
      to.reserve(to.size() + from.size() + from.size() * pieces_left_);
    to.insert(to.end(), from.begin(), from.end());
  }

  void use_material(const ObjPiece::MaterialUse& use) {
    const auto [entry, is_new] = materials_.emplace(
        std::string(use.name), static_cast<std::uint32_t>(result_.materials.size()));
    if (is_new) result_.materials.emplace_back(use.name);
    polygons_.runs.push_back({polygons_.faces() + use.first_face, entry->second});
  }

  void check_numbers() const {
    for (std::size_t e = 0; e < early_.size(); ++e) {
      const std::int64_t count = place_.counts[e];
      if (early_[e].number > count)
        throw MeshFileError("the file has " + std::to_string(count) + " " + obj_elements[e] +
                                (count == 1 ? "" : "s") + ", but a face uses number " +
                                std::to_string(early_[e].number),
                            early_[e].line, early_[e].column, early_[e].excerpt);
    }
  }

  // Makes one vertex for each combination of indices that corners use.
  void make_vertices() {
    const auto& [uvs, normals] = numbers_;
    if (!uvs.own() && !normals.own()) {
      // Each position is a vertex.
      const std::size_t count = polygons_.positions.size();
      polygons_.uvs.resize(uvs.none() ? 0 : count);
      polygons_.normals.resize(normals.none() ? 0 : count);
      return;
    }
    // The vertices of a position form a chain. A chain that is too long to search gets duplicates,
    // which do no harm.
    constexpr int most_links = 16;
    std::vector<std::uint32_t> first(polygons_.positions.size(), no_index);
    std::vector<std::uint32_t> next;
    std::vector<PolygonVertex>& vertices = polygons_.vertices;
    const std::span<std::uint32_t> corners = polygons_.all_corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t position = corners[i];
      const PolygonVertex wanted{position, uvs.at(i, position), normals.at(i, position)};
      std::uint32_t vertex = first[position];
      bool known = false;
      for (int links = 0; vertex != no_index && links < most_links && !known; ++links) {
        known = vertices[vertex].uv == wanted.uv && vertices[vertex].normal == wanted.normal;
        if (!known) vertex = next[vertex];
      }
      if (!known) {
        vertex = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(wanted);
        next.push_back(std::exchange(first[position], vertex));
      }
      corners[i] = vertex;
    }
  }

  StatementText text_;
  std::uint64_t pieces_left_;  // approximate
  std::uint64_t max_triangles_;
  ObjPlace place_;  // of the next text
  std::vector<Slot> slots_;
  PolygonMesh polygons_;
  std::array<CornerNumbers, 2> numbers_;  // of texture coordinates and normals
  std::array<ObjPiece::Early, 3> early_;
  ObjFile result_;
  std::unordered_map<std::string, std::uint32_t> materials_;
  std::vector<ObjPiece::Ignored> ignored_;
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& file, const MeshFileOptions& options,
                 std::size_t piece_bytes) {
  return ObjReader(file, options, piece_bytes).read();
}

}  // namespace pah
