// Reads the numbers of a glTF file: buffers, buffer views, accessors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "load/mesh/gltf/document.hpp"

namespace pah {

class GltfBuffers {
 public:
  // Reads all buffers. Accessors with more than `max_count` elements are refused. The document must
  // outlive the object. All functions throw MeshFileError.
  GltfBuffers(const GltfDocument& document, std::uint64_t max_count);

  [[nodiscard]] std::string_view view(std::size_t index) const;

  // Returns the elements, `components` numbers each. Elements without data are 0. `name` is for
  // errors.
  [[nodiscard]] std::vector<float> floats(std::size_t accessor, std::size_t components,
                                          const std::string& name) const;
  // The number of components of an element: 3 for "VEC3".
  [[nodiscard]] std::size_t components(std::size_t accessor) const;
  // Reads whole numbers.
  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor) const;

 private:
  struct Array;
  template <class Value>
  [[nodiscard]] std::vector<Value> values(const Json& accessor, std::size_t components,
                                          const std::string& name) const;
  [[nodiscard]] Array array_of(const Json& source, std::uint64_t count, int component_type,
                               std::size_t components, const std::string& name) const;

  const GltfDocument& document_;
  std::uint64_t max_count_;
  std::vector<std::string> owned_;  // data of buffers other than the binary chunk
  std::vector<std::string_view> buffers_;
};

}  // namespace pah
