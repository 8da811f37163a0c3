#include "load/mesh/ply/header.hpp"

#include <charconv>
#include <pah/load/mesh_file.hpp>

#include "load/mesh/common/text.hpp"

namespace pah {
namespace {

struct TypeName {
  const char* names[2];
  PlyType type;
  std::size_t bytes;
};

// In the order of PlyType.
constexpr TypeName types[] = {
    {{"char", "int8"}, PlyType::i8, 1},      {{"uchar", "uint8"}, PlyType::u8, 1},
    {{"short", "int16"}, PlyType::i16, 2},   {{"ushort", "uint16"}, PlyType::u16, 2},
    {{"int", "int32"}, PlyType::i32, 4},     {{"uint", "uint32"}, PlyType::u32, 4},
    {{"float", "float32"}, PlyType::f32, 4}, {{"double", "float64"}, PlyType::f64, 8}};

class HeaderReader {
 public:
  explicit HeaderReader(FileReader& file) : file_(file) {}

  PlyHeader read() {
    if (!next_line() || Words(line_).next() != "ply") fail("a PLY file starts with 'ply'");
    bool has_format = false;
    while (next_line() && file_.line_number() < 10'000) {
      Words words(line_);
      const std::string_view keyword = words.next();
      if (keyword == "format") {
        read_format(words.next());
        has_format = true;
      } else if (keyword == "element") {
        read_element(words);
      } else if (keyword == "property") {
        read_property(words);
      } else if (keyword == "end_header") {
        if (!has_format) fail("the header names no format");
        check_sizes();
        return std::move(header_);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail("unknown keyword '" + excerpt_of(keyword.substr(0, 40)) + "'", keyword);
      }
    }
    throw MeshFileError("the header does not end");
  }

 private:
  [[noreturn]] void fail(const std::string& message, std::string_view word = {}) const {
    const auto column = word.data() == nullptr ? 1 : word.data() - line_.data() + 1;
    throw MeshFileError(message, file_.line_number(), static_cast<int>(column), excerpt_of(line_));
  }

  bool next_line() {
    const auto line = file_.line();
    line_ = line.value_or("");
    return line.has_value();
  }

  [[nodiscard]] PlyType type_of(std::string_view name) const {
    for (const TypeName& type : types)
      if (name == type.names[0] || name == type.names[1]) return type.type;
    fail("unknown number type '" + excerpt_of(name.substr(0, 40)) + "'", name);
  }

  void read_format(std::string_view word) {
    if (word == "ascii")
      header_.format = PlyFormat::ascii;
    else if (word == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (word == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      fail("unknown format '" + excerpt_of(word.substr(0, 40)) + "'", word);
  }

  void read_element(Words& words) {
    PlyElement element;
    element.name = words.next();
    const std::string_view word = words.next();
    const auto [end, wrong] =
        std::from_chars(word.data(), word.data() + word.size(), element.count);
    if (wrong != std::errc{} || end != word.data() + word.size())
      fail("'" + excerpt_of(word.substr(0, 40)) + "' is not a number of elements", word);
    // Each element takes at least a byte.
    if (element.count > file_.size())
      fail("the file is too short for '" + excerpt_of(line_) + "'", word);
    header_.elements.push_back(std::move(element));
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view word = words.next();
    if (word == "list") {
      property.is_list = true;
      property.count_type = type_of(words.next());
      if (property.count_type == PlyType::f32 || property.count_type == PlyType::f64)
        fail("the length of a list is a whole number");
      word = words.next();
    }
    property.type = type_of(word);
    property.name = words.next();
    header_.elements.back().properties.push_back(std::move(property));
  }

  // Checks the least size of all elements. In text, a number takes a digit and a blank.
  void check_sizes() const {
    for (const PlyElement& element : header_.elements) {
      std::uint64_t bytes = 0;
      for (const PlyProperty& property : element.properties)
        bytes += header_.format == PlyFormat::ascii
                     ? 2
                     : size_of(property.is_list ? property.count_type : property.type);
      if (element.count > 0 && bytes > (file_.left() + 1) / element.count)
        throw MeshFileError("the file is too short for its " + std::to_string(element.count) +
                            " elements '" + element.name + "'");
    }
  }

  FileReader& file_;
  PlyHeader header_;
  std::string_view line_;
};

}  // namespace

std::size_t size_of(PlyType type) { return types[static_cast<std::size_t>(type)].bytes; }

PlyHeader read_ply_header(FileReader& file) { return HeaderReader(file).read(); }

}  // namespace pah
