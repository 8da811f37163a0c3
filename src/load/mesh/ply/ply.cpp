#include "load/mesh/ply/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>

#include "load/mesh/common/text.hpp"
#include "load/mesh/ply/header.hpp"

namespace pah {
namespace {

template <class T>
T swapped(T value) {
  std::array<unsigned char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

template <class T>
double load(const char* bytes, bool swaps) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(swaps ? swapped(value) : value);
}

double load(const char* bytes, PlyType type, bool swaps) {
  switch (type) {
    case PlyType::i8:
      return load<std::int8_t>(bytes, false);
    case PlyType::u8:
      return load<std::uint8_t>(bytes, false);
    case PlyType::i16:
      return load<std::int16_t>(bytes, swaps);
    case PlyType::u16:
      return load<std::uint16_t>(bytes, swaps);
    case PlyType::i32:
      return load<std::int32_t>(bytes, swaps);
    case PlyType::u32:
      return load<std::uint32_t>(bytes, swaps);
    case PlyType::f32:
      return load<float>(bytes, swaps);
    case PlyType::f64:
      return load<double>(bytes, swaps);
  }
  return 0;
}

// A vertex's numbers in slots: position, normal, texture coordinates.
constexpr int slot_count = 8;

// Returns -1 for a property that is ignored.
int slot_of(std::string_view name) {
  constexpr std::string_view names[] = {"x", "y", "z", "nx", "ny",        "nz",
                                        "u", "v", "s", "t",  "texture_u", "texture_v"};
  const auto* const found = std::find(std::begin(names), std::end(names), name);
  const auto index = static_cast<int>(found - std::begin(names));
  if (index >= static_cast<int>(std::size(names))) return -1;
  return index < slot_count ? index : 6 + index % 2;
}

enum class ListUse { none, corners, strip, uvs };

// Reads the numbers of elements in turn, from text or bytes.
class PlyReader {
 public:
  PlyReader(const std::filesystem::path& file, const MeshFileOptions& options)
      : file_(file, options.file_bytes), max_triangles_(options.triangles) {}

  PolygonMesh read(std::vector<std::string>& warnings) {
    header_ = read_ply_header(file_);
    text_ = header_.format == PlyFormat::ascii;
    swaps_ = (header_.format == PlyFormat::big_endian) != (std::endian::native == std::endian::big);
    for (const PlyElement& element : header_.elements)
      if (element.name == "vertex") check_vertex(element);
    for (const PlyElement& element : header_.elements) {
      begin(element);
      for (index_ = 0; index_ < element.count; ++index_) read_element(element);
    }
    finish(warnings);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, std::string_view word = {}) const {
    if (!text_) throw MeshFileError(message);
    const auto column = word.data() == nullptr ? 1 : word.data() - line_.data() + 1;
    throw MeshFileError(message, file_.line_number(), static_cast<int>(column), excerpt_of(line_));
  }

  // Returns the current element's name and index: "vertex 7".
  [[nodiscard]] std::string which() const { return element_->name + " " + std::to_string(index_); }

  [[noreturn]] void fail_at_end() const {
    throw MeshFileError("the file ends before " + which() + " of " +
                        std::to_string(element_->count));
  }

  // Resolves the names of properties once for all elements.
  void begin(const PlyElement& element) {
    element_ = &element;
    is_vertex_ = element.name == "vertex";
    is_face_ = element.name == "face";
    is_strips_ = element.name == "tristrips";
    reserve(element.count);
    slots_.clear();
    uses_.clear();
    for (const PlyProperty& property : element.properties) {
      const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
      slots_.push_back(slot_of(property.name));
      uses_.push_back(corners && is_face_                       ? ListUse::corners
                      : corners && is_strips_                   ? ListUse::strip
                      : is_face_ && property.name == "texcoord" ? ListUse::uvs
                                                                : ListUse::none);
    }
  }

  // Reserves what most files need, but never more than the file can hold, whatever its header
  // claims.
  void reserve(std::uint64_t count) {
    constexpr std::uint64_t least_bytes = 12;  // three floats or indices
    const auto expected = static_cast<std::size_t>(std::min(count, file_.left() / least_bytes));
    if (is_vertex_) {
      mesh_.positions.reserve(expected);
      mesh_.normals.reserve(has_normals_ ? expected : 0);
      mesh_.uvs.reserve(has_uvs_ ? expected : 0);
    }
    if (is_face_) {
      mesh_.corners.reserve(3 * expected);
      mesh_.face_sizes.reserve(expected);
    }
  }

  void check_vertex(const PlyElement& element) {
    if (has_vertices_) throw MeshFileError("the header has two elements 'vertex'");
    has_vertices_ = true;
    vertices_ = element.count;
    std::uint32_t given = 0;
    for (const PlyProperty& property : element.properties)
      if (const int slot = slot_of(property.name); slot >= 0 && !property.is_list)
        given |= 1U << slot;
    if ((given & 7U) != 7U) throw MeshFileError("its vertices have no x, y and z");
    has_normals_ = (given >> 3 & 7U) == 7U;
    has_uvs_ = given >> 6 == 3U;
  }

  void read_element(const PlyElement& element) {
    if (text_) next_line();
    if (is_vertex_)
      read_vertex(element);
    else
      read_other(element);
    if (!text_) return;
    if (const std::string_view word = words_.next(); !word.empty())
      fail("there are more numbers than " + which() + " has by the header", word);
  }

  // Each element has its own line, except for elements without properties.
  void next_line() {
    words_ = Words("");
    if (element_->properties.empty()) return;
    do {
      const auto line = file_.line();
      if (!line) fail_at_end();
      line_ = *line;
      words_ = Words(line_);
    } while (Words(line_).next().empty());
  }

  double next_number(PlyType type) {
    if (!text_) return load(next_bytes(type), type, swaps_);
    next_word();
    // Floats cannot represent all whole numbers above 2^24.
    const char* const first = word_.data();
    const char* const last = first + word_.size();
    std::int64_t whole = 0;
    const bool real = type == PlyType::f32 || type == PlyType::f64;
    if (!real) {
      const auto [end, error] = std::from_chars(first, last, whole);
      if (error == std::errc{} && end == last) return static_cast<double>(whole);
    }
    float value = 0;
    if (!read_float(word_, value))
      fail("'" + excerpt_of(word_.substr(0, 40)) + "' is not a finite number", word_);
    return value;
  }

  void skip_number(PlyType type) {
    if (text_)
      next_word();
    else
      (void)next_bytes(type);
  }

  const char* next_bytes(PlyType type) {
    const char* const bytes = file_.bytes(size_of(type));
    if (bytes == nullptr) fail_at_end();
    return bytes;
  }

  void next_word() {
    word_ = words_.next();
    if (word_.empty()) fail("the line ends too soon", line_.substr(line_.size()));
  }

  void read_vertex(const PlyElement& element) {
    float values[slot_count] = {};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list) {
        read_list(property, ListUse::none);
        continue;
      }
      const int slot = slots_[i];
      if (slot < 0) {
        skip_number(property.type);
        continue;
      }
      const auto value = static_cast<float>(next_number(property.type));
      if (!std::isfinite(value))
        fail("'" + property.name + "' of " + which() + " is not finite", word_);
      values[slot] = value;
    }
    mesh_.positions.emplace_back(values[0], values[1], values[2]);
    if (has_normals_) mesh_.normals.emplace_back(values[3], values[4], values[5]);
    if (has_uvs_) mesh_.uvs.emplace_back(values[6], values[7]);
  }

  void read_other(const PlyElement& element) {
    list_.clear();
    uvs_.clear();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list)
        read_list(property, uses_[i]);
      else
        skip_number(property.type);
    }
    if (is_face_) add_face();
    if (is_strips_) add_strip();
  }

  void read_list(const PlyProperty& property, ListUse use) {
    const double length = next_number(property.count_type);
    const double most = use == ListUse::corners ? max_polygon_corners
                        : use == ListUse::uvs   ? 2 * max_polygon_corners
                                                : static_cast<double>(file_.size());
    if (!(length >= 0 && length <= most && length == std::floor(length)))
      fail(which() + " has a list of invalid length", word_);
    for (double i = 0; i < length; ++i) {
      if (use == ListUse::none)
        skip_number(property.type);
      else if (use == ListUse::uvs)
        add_uv(next_number(property.type));
      else
        add_corner(next_number(property.type), use == ListUse::strip);
    }
  }

  void add_uv(double value) {
    uvs_.push_back(static_cast<float>(value));
    if (!std::isfinite(uvs_.back()))
      fail("a texture coordinate of " + which() + " is not finite", word_);
  }

  void add_corner(double value, bool in_strip) {
    const bool ends_strip = in_strip && value < 0;
    if (!ends_strip && !(value >= 0 && value < static_cast<double>(vertices_)))
      fail(which() + " uses vertex " + fmt::format("{:.0f}", value) + " of " +
               std::to_string(vertices_),
           word_);
    list_.push_back(ends_strip ? no_index : static_cast<std::uint32_t>(value));
  }

  void add_face() {
    const bool own_uvs = uvs_.size() == 2 * list_.size();
    if (list_.size() < 3) return;  // a point or a line
    if (own_uvs || !corner_uvs_.empty()) {
      // Earlier faces may have no texture coordinates.
      corner_uvs_.resize(mesh_.corners.size(), Vec2(0));
      for (std::size_t k = 0; k < list_.size(); ++k)
        corner_uvs_.push_back(own_uvs ? Vec2(uvs_[2 * k], uvs_[2 * k + 1]) : Vec2(0));
    }
    add(list_);
  }

  // Every other triangle is wound the other way; -1 starts a new strip.
  void add_strip() {
    for (auto begin = list_.begin(); begin != list_.end();) {
      const auto end = std::find(begin, list_.end(), no_index);
      for (auto at = begin; end - at > 2; ++at) {
        const std::ptrdiff_t odd = (at - begin) % 2;
        add(std::array{at[0], at[1 + odd], at[2 - odd]});
      }
      begin = end == list_.end() ? end : end + 1;
    }
  }

  void add(std::span<const std::uint32_t> corners) {
    mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
    mesh_.face_sizes.push_back(static_cast<std::uint16_t>(corners.size()));
    triangles_ += corners.size() - 2;
    if (triangles_ > max_triangles_)
      fail("more than " + std::to_string(max_triangles_) + " triangles");
  }

  void finish(std::vector<std::string>& warnings) {
    if (text_) {
      while (const auto line = file_.line())
        if (!Words(*line).next().empty()) {
          warnings.push_back(
              "line " + std::to_string(file_.line_number()) +
              " and everything after it exceeds what the header declares, and is left out");
          break;
        }
    } else if (file_.left() > 0) {
      warnings.push_back(std::to_string(file_.left()) +
                         " bytes exceed what the header declares, and are left out");
    }
    if (corner_uvs_.empty()) return;
    // Each corner becomes a vertex of its own.
    corner_uvs_.resize(mesh_.corners.size(), Vec2(0));
    mesh_.uvs = std::move(corner_uvs_);
    for (std::size_t i = 0; i < mesh_.corners.size(); ++i) {
      const std::uint32_t corner = mesh_.corners[i];
      mesh_.vertices.push_back(
          {corner, static_cast<std::uint32_t>(i), mesh_.normals.empty() ? no_index : corner});
      mesh_.corners[i] = static_cast<std::uint32_t>(i);
    }
  }

  FileReader file_;
  std::uint64_t max_triangles_;
  std::uint64_t triangles_ = 0;
  PlyHeader header_;
  bool text_ = true;
  bool swaps_ = false;  // bytes of numbers
  bool has_vertices_ = false;
  bool has_normals_ = false;
  bool has_uvs_ = false;
  std::uint64_t vertices_ = 0;
  PolygonMesh mesh_;
  std::vector<Vec2> corner_uvs_;  // of all corners so far, if any face has texture coordinates

  // The current element.
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;
  bool is_vertex_ = false;
  bool is_face_ = false;
  bool is_strips_ = false;
  std::vector<int> slots_;     // of its properties, if it is a vertex
  std::vector<ListUse> uses_;  // of its properties, if it is a face or strip
  std::string_view line_;
  std::string_view word_;  // the last number read
  Words words_{""};
  std::vector<std::uint32_t> list_;
  std::vector<float> uvs_;
};

}  // namespace

PolygonMesh read_ply(const std::filesystem::path& file, const MeshFileOptions& options,
                     std::vector<std::string>& warnings) {
  return PlyReader(file, options).read(warnings);
}

}  // namespace pah
