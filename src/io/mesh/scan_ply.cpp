#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <pah/io/mesh_file.hpp>
#include <string>
#include <vector>

#include "io/mesh/scan.hpp"
#include "io/mesh/text.hpp"

namespace pah {
namespace {

struct NumberType {
  const char* names[2];
  std::size_t bytes;
  bool real;
  bool has_sign;
};

constexpr NumberType number_types[] = {
    {{"char", "int8"}, 1, false, true},    {{"uchar", "uint8"}, 1, false, false},
    {{"short", "int16"}, 2, false, true},  {{"ushort", "uint16"}, 2, false, false},
    {{"int", "int32"}, 4, false, true},    {{"uint", "uint32"}, 4, false, false},
    {{"float", "float32"}, 4, true, true}, {{"double", "float64"}, 8, true, true}};

struct Property {
  std::string name;
  const NumberType* type = nullptr;
  const NumberType* count = nullptr;  // of lists
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

constexpr double max_corners = 10'000;

// Reads a PLY file from end to end, keeps nothing, and throws at what is wrong with it.
class PlyScan {
 public:
  explicit PlyScan(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
    std::error_code error;
    bytes_ = std::filesystem::file_size(file, error);
  }

  void run() {
    read_header();
    for (const Element& element : elements_)
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (format_ == Format::ascii)
          read_line_of(element, i);
        else
          read_bytes_of(element, i);
      }
  }

 private:
  enum class Format { ascii, little, big };

  [[noreturn]] void fail(const std::string& message, std::string_view word = {}) const {
    const bool in_text = format_ == Format::ascii || in_header_;
    if (!in_text) throw MeshFileError(message);
    const auto column = word.data() == nullptr ? 1 : word.data() - line_.data() + 1;
    throw MeshFileError(message, line_number_, static_cast<int>(column), excerpt_of(line_));
  }

  bool next_line() {
    ++line_number_;
    return static_cast<bool>(std::getline(stream_, line_));
  }

  const NumberType* type_of(std::string_view name) const {
    for (const NumberType& type : number_types)
      if (name == type.names[0] || name == type.names[1]) return &type;
    fail("unknown number type '" + std::string(name) + "'", name);
  }

  void read_header() {
    if (!next_line() || Words(line_).next() != "ply") fail("a PLY file starts with 'ply'");
    bool has_format = false;
    while (next_line() && line_number_ < 1000) {
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
        in_header_ = false;
        return;
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail("unknown keyword '" + std::string(keyword.substr(0, 40)) + "'", keyword);
      }
    }
    throw MeshFileError("the header does not end");
  }

  void read_format(std::string_view word) {
    if (word == "ascii")
      format_ = Format::ascii;
    else if (word == "binary_little_endian")
      format_ = Format::little;
    else if (word == "binary_big_endian")
      format_ = Format::big;
    else
      fail("unknown format '" + std::string(word.substr(0, 40)) + "'", word);
  }

  void read_element(Words& words) {
    Element element;
    element.name = words.next();
    const std::string_view word = words.next();
    const auto [end, wrong] =
        std::from_chars(word.data(), word.data() + word.size(), element.count);
    // Every element takes at least a byte.
    if (wrong != std::errc{} || end != word.data() + word.size() || element.count > bytes_)
      fail("the file is too short for '" + excerpt_of(line_) + "'", word);
    if (element.name == "vertex") vertices_ = element.count;
    elements_.push_back(std::move(element));
  }

  void read_property(Words& words) {
    if (elements_.empty()) fail("a property before the first element");
    Property property;
    std::string_view word = words.next();
    if (word == "list") {
      property.count = type_of(words.next());
      if (property.count->real) fail("the length of a list is a whole number");
      word = words.next();
    }
    property.type = type_of(word);
    property.name = words.next();
    elements_.back().properties.push_back(std::move(property));
  }

  // Vertices have finite numbers, faces the numbers of vertices.
  void check(const Element& element, const Property& property, std::uint64_t index, double value,
             std::string_view word = {}) const {
    const auto which = [&] { return element.name + " " + std::to_string(index); };
    if (element.name == "vertex" && property.count == nullptr && !(std::abs(value) <= 3.4028234e38))
      fail("'" + property.name + "' of " + which() + " is not finite", word);
    const bool names_vertices =
        property.name == "vertex_indices" || property.name == "vertex_index";
    if (names_vertices && !(value >= 0 && value < static_cast<double>(vertices_)))
      fail(which() + " uses vertex " + std::to_string(static_cast<long long>(value)) + " of " +
               std::to_string(vertices_),
           word);
  }

  void check_length(const Element& element, std::uint64_t index, double length,
                    std::string_view word = {}) const {
    if (!(length >= 0 && length <= max_corners && length == std::floor(length)))
      fail(element.name + " " + std::to_string(index) + " has a list of no sensible length", word);
  }

  void read_line_of(const Element& element, std::uint64_t index) {
    do {
      if (!next_line())
        throw MeshFileError("the file ends before " + element.name + " " + std::to_string(index) +
                            " of " + std::to_string(element.count));
    } while (Words(line_).next().empty());
    Words words(line_);
    const auto number = [&] {
      const std::string_view word = words.next();
      if (word.empty())
        fail("the line ends too soon", std::string_view(line_).substr(line_.size()));
      if (!is_finite_number(word))
        fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number", word);
      double value = 0;
      const bool plus = word.front() == '+';
      std::from_chars(word.data() + (plus ? 1 : 0), word.data() + word.size(), value);
      return std::pair{value, word};
    };
    for (const Property& property : element.properties) {
      double length = 1;
      if (property.count != nullptr) {
        const auto [value, word] = number();
        check_length(element, index, value, word);
        length = value;
      }
      for (double i = 0; i < length; ++i) {
        const auto [value, word] = number();
        check(element, property, index, value, word);
      }
    }
  }

  double read_number(const NumberType& type, const Element& element, std::uint64_t index) {
    std::array<unsigned char, 8> raw{};
    stream_.read(reinterpret_cast<char*>(raw.data()), static_cast<std::streamsize>(type.bytes));
    if (!stream_)
      fail("the file ends before " + element.name + " " + std::to_string(index) + " of " +
           std::to_string(element.count));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i)
      bits |= std::uint64_t{raw[format_ == Format::big ? type.bytes - 1 - i : i]} << (8 * i);
    if (type.real)
      return type.bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                             : std::bit_cast<double>(bits);
    const std::size_t unused = 64 - 8 * type.bytes;
    return type.has_sign ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                         : static_cast<double>(bits);
  }

  void read_bytes_of(const Element& element, std::uint64_t index) {
    for (const Property& property : element.properties) {
      double length = 1;
      if (property.count != nullptr) {
        length = read_number(*property.count, element, index);
        check_length(element, index, length);
      }
      for (double i = 0; i < length; ++i)
        check(element, property, index, read_number(*property.type, element, index));
    }
  }

  std::ifstream stream_;
  std::uint64_t bytes_ = 0;
  Format format_ = Format::ascii;
  bool in_header_ = true;
  std::vector<Element> elements_;
  std::uint64_t vertices_ = 0;
  std::string line_;
  int line_number_ = 0;
};

}  // namespace

void scan_ply(const std::filesystem::path& file) { PlyScan(file).run(); }

}  // namespace pah
