// Reads the header of a PLY file, which describes its data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "load/mesh/common/file_reader.hpp"

namespace pah {

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

[[nodiscard]] std::size_t size_of(PlyType type);  // in bytes

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool is_list = false;
  PlyType count_type = PlyType::u8;  // of a list's length; an integer type
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

// Reads up to the line after the header. Throws MeshFileError, also if the elements cannot fit the
// file.
[[nodiscard]] PlyHeader read_ply_header(FileReader& file);

}  // namespace pah
