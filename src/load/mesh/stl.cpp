#include "load/mesh/stl.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "base/little_endian.hpp"
#include "load/mesh/common/file_reader.hpp"
#include "load/mesh/common/text.hpp"

namespace pah {
namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t triangle_bytes = 50;  // normal, corners, two unused bytes

// Ignores case: some programs write keywords in capitals.
bool is(std::string_view expected, std::string_view word) {
  if (word.size() != expected.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((word[i] | ' ') != expected[i]) return false;
  return true;
}

class StlReader {
 public:
  StlReader(const std::filesystem::path& file, const MeshFileOptions& options)
      : file_(file, options.file_bytes), max_triangles_(options.triangles) {}

  PolygonMesh read_binary(std::vector<std::string>& warnings) {
    const char* const head = file_.bytes(header_bytes + 4);
    if (head == nullptr) throw MeshFileError("the file is too short for STL");
    const std::uint32_t count = load_u32(head + header_bytes);
    for (std::uint32_t i = 0; i < count; ++i) {
      const char* const bytes = file_.bytes(triangle_bytes);
      if (bytes == nullptr)
        throw MeshFileError("the file ends before triangle " + std::to_string(i) + " of " +
                            std::to_string(count));
      for (std::size_t corner = 1; corner < 4; ++corner) {
        Vec3 position;
        for (int axis = 0; axis < 3; ++axis)
          position[axis] = std::bit_cast<float>(
              load_u32(bytes + 12 * corner + 4 * static_cast<std::size_t>(axis)));
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
          throw MeshFileError("a position of triangle " + std::to_string(i) + " is not finite");
        mesh_.positions.push_back(position);
      }
      end_triangle();
    }
    if (file_.left() > 0)
      warnings.push_back(std::to_string(file_.left()) + " bytes after the " +
                         std::to_string(count) + " triangles are left out");
    return std::move(mesh_);
  }

  // Reads only corners; every third ends a triangle.
  PolygonMesh read_text() {
    while (const auto line = file_.line()) {
      text_ = *line;
      Words words(text_);
      const std::string_view keyword = words.next();
      if (is("endfacet", keyword) && mesh_.positions.size() % 3 != 0)
        fail("a facet has three corners", 1);
      if (!is("vertex", keyword)) continue;
      Vec3 position;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = words.next();
        if (!read_float(word, position[axis]))
          fail("'" + excerpt_of(word.substr(0, 40)) + "' is not a finite number",
               words.column_of(word));
      }
      mesh_.positions.push_back(position);
      if (mesh_.positions.size() % 3 == 0) end_triangle();
    }
    if (mesh_.positions.size() % 3 != 0) throw MeshFileError("the file ends within a facet");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, int column) const {
    throw MeshFileError(message, file_.line_number(), column, excerpt_of(text_));
  }

  void end_triangle() {
    if (mesh_.face_sizes.size() == max_triangles_)
      throw MeshFileError("more than " + std::to_string(max_triangles_) + " triangles");
    for (std::size_t k = 3; k > 0; --k)
      mesh_.corners.push_back(static_cast<std::uint32_t>(mesh_.positions.size() - k));
    mesh_.face_sizes.push_back(3);
  }

  FileReader file_;
  std::uint64_t max_triangles_;
  PolygonMesh mesh_;
  std::string_view text_;
};

// Binary files may begin with "solid" too, so the size decides.
bool is_binary(const std::filesystem::path& file, const MeshFileOptions& options) {
  FileReader reader(file, options.file_bytes);
  const std::uint64_t size = reader.size();
  const char* const head = reader.bytes(header_bytes + 4);
  if (head != nullptr &&
      size == header_bytes + 4 + triangle_bytes * std::uint64_t{load_u32(head + header_bytes)})
    return true;
  FileReader text_reader(file, options.file_bytes);
  const auto line = text_reader.line();
  return !line || !is("solid", Words(without_byte_order_mark(*line)).next().substr(0, 5));
}

}  // namespace

PolygonMesh read_stl(const std::filesystem::path& file, const MeshFileOptions& options,
                     std::vector<std::string>& warnings) {
  StlReader reader(file, options);
  return is_binary(file, options) ? reader.read_binary(warnings) : reader.read_text();
}

}  // namespace pah
