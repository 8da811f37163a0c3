#include "load/mesh/gltf/buffers.hpp"

#include <bit>
#include <cstring>
#include <pah/load/mesh_file.hpp>
#include <utility>

#include "base/little_endian.hpp"

namespace pah {
namespace {

enum ComponentType : int { i8 = 5120, u8, i16, u16, u32 = 5125, f32 };

std::size_t size_of(int type, const std::string& name) {
  switch (type) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case u32:
    case f32:
      return 4;
    default:
      throw MeshFileError(name + " has an unknown component type");
  }
}

std::size_t components_of(const std::string& type, const std::string& name) {
  constexpr std::pair<const char*, std::size_t> types[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [known, count] : types)
    if (type == known) return count;
  throw MeshFileError(name + " is of an unknown type");
}

std::uint32_t load_u16(const char* bytes) {
  return static_cast<unsigned char>(bytes[0]) |
         static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[1])) << 8U;
}

float load(const char* bytes, int type) {
  switch (type) {
    case i8:
      return static_cast<float>(static_cast<std::int8_t>(bytes[0]));
    case u8:
      return static_cast<float>(static_cast<unsigned char>(bytes[0]));
    case i16:
      return static_cast<float>(static_cast<std::int16_t>(load_u16(bytes)));
    case u16:
      return static_cast<float>(load_u16(bytes));
    case u32:
      return static_cast<float>(load_u32(bytes));
    default:
      return std::bit_cast<float>(load_u32(bytes));
  }
}

// Normalized integers represent [-1, 1] or [0, 1] (glTF 2.0, 3.6.2.2).
float largest(int type) {
  switch (type) {
    case i8:
      return 127;
    case u8:
      return 255;
    case i16:
      return 32767;
    case u16:
      return 65535;
    default:
      return 1;
  }
}

}  // namespace

// An array of numbers in a buffer.
struct GltfBuffers::Array {
  std::string_view bytes;
  std::uint64_t stride = 0;
  int type = 0;
  std::size_t component_size = 0;

  template <class Value>
  [[nodiscard]] Value at(std::uint64_t element, std::size_t component) const {
    const char* const here = bytes.data() + element * stride + component * component_size;
    if constexpr (std::is_same_v<Value, float>) return load(here, type);
    return type == u8    ? static_cast<unsigned char>(*here)
           : type == u16 ? static_cast<Value>(load_u16(here))
                         : static_cast<Value>(load_u32(here));
  }
};

GltfBuffers::GltfBuffers(const GltfDocument& document, std::uint64_t max_count)
    : document_(document), max_count_(max_count) {
  const Json& buffers = list(document.json, "buffers");
  owned_.reserve(buffers.size());  // views refer to them
  for (const Json& buffer : buffers) {
    const std::uint64_t length = number(buffer, "byteLength", 0);
    std::string_view bytes = document.binary;
    if (buffer.contains("uri")) {
      owned_.push_back(document.data_of(buffer.at("uri").get_ref<const std::string&>()));
      bytes = owned_.back();
    }
    if (bytes.size() < length)
      throw MeshFileError("buffer " + std::to_string(buffers_.size()) + " has " +
                          std::to_string(bytes.size()) + " bytes of " + std::to_string(length));
    buffers_.push_back(bytes.substr(0, length));
  }
}

std::string_view GltfBuffers::view(std::size_t index) const {
  const Json& view = list(document_.json, "bufferViews").at(index);
  const std::string_view buffer = buffers_[index_of(view, "buffer", buffers_.size())];
  const std::uint64_t offset = number(view, "byteOffset", 0);
  const std::uint64_t length = number(view, "byteLength", 0);
  if (offset + length > buffer.size())
    throw MeshFileError("buffer view " + std::to_string(index) + " goes beyond its buffer");
  return buffer.substr(offset, length);
}

GltfBuffers::Array GltfBuffers::array_of(const Json& source, std::uint64_t count,
                                         int component_type, std::size_t components,
                                         const std::string& name) const {
  const Json& views = list(document_.json, "bufferViews");
  const std::size_t index = index_of(source, "bufferView", views.size());
  Array array{view(index), number(views[index], "byteStride", 0), component_type,
              size_of(component_type, name)};
  const std::uint64_t size = components * array.component_size;
  if (array.stride == 0) array.stride = size;
  const std::uint64_t offset = number(source, "byteOffset", 0);
  if (count == 0 || array.stride < size || array.stride > 65536 || count > array.bytes.size() ||
      offset + (count - 1) * array.stride + size > array.bytes.size())
    throw MeshFileError(name + " is empty or goes beyond its buffer view");
  array.bytes.remove_prefix(offset);
  return array;
}

template <class Value>
std::vector<Value> GltfBuffers::values(const Json& accessor, std::size_t components,
                                       const std::string& name) const {
  const std::uint64_t count = number(accessor, "count", 0);
  const int type = static_cast<int>(number(accessor, "componentType", 0));
  (void)size_of(type, name);
  if (count == 0) throw MeshFileError(name + " is empty");
  if (count > max_count_) throw MeshFileError(name + " has too many elements");
  std::vector<Value> values(count * components);
  if (accessor.contains("bufferView")) {
    const Array array = array_of(accessor, count, type, components, name);
    for (std::uint64_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < components; ++k)
        values[i * components + k] = array.at<Value>(i, k);
  }
  const Json& sparse = child(accessor, "sparse");
  if (!sparse.empty()) {
    const std::uint64_t changes = number(sparse, "count", 0);
    const Json& places = sparse.at("indices");
    const Array where =
        array_of(places, changes, static_cast<int>(number(places, "componentType", 0)), 1,
                 name + "'s sparse part");
    const Array what =
        array_of(sparse.at("values"), changes, type, components, name + "'s sparse part");
    for (std::uint64_t i = 0; i < changes; ++i) {
      const auto place = where.at<std::uint32_t>(i, 0);
      if (place >= count) throw MeshFileError(name + "'s sparse part goes beyond it");
      for (std::size_t k = 0; k < components; ++k)
        values[place * components + k] = what.at<Value>(i, k);
    }
  }
  return values;
}

std::size_t GltfBuffers::components(std::size_t accessor) const {
  const Json& source = list(document_.json, "accessors").at(accessor);
  return components_of(source.value("type", std::string()), "accessor " + std::to_string(accessor));
}

std::vector<float> GltfBuffers::floats(std::size_t accessor, std::size_t components,
                                       const std::string& name) const {
  const std::string place = "accessor " + std::to_string(accessor);
  const Json& source = list(document_.json, "accessors").at(accessor);
  if (components_of(source.value("type", std::string()), place) != components)
    throw MeshFileError(name + " is not of " + std::to_string(components) + " numbers each");
  std::vector<float> result = values<float>(source, components, place);
  if (source.value("normalized", false)) {
    const float one = largest(source.at("componentType").get<int>());
    for (float& value : result) value = std::max(value / one, -1.0F);
  }
  return result;
}

std::vector<std::uint32_t> GltfBuffers::indices(std::size_t accessor) const {
  const Json& source = list(document_.json, "accessors").at(accessor);
  const std::uint64_t type = number(source, "componentType", 0);
  if (source.value("type", std::string()) != "SCALAR" || (type != u8 && type != u16 && type != u32))
    throw MeshFileError("the indices of a mesh are not whole numbers");
  return values<std::uint32_t>(source, 1, "accessor " + std::to_string(accessor));
}

}  // namespace pah
