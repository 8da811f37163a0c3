// The buffers, buffer views and accessors of a glTF file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "load/mesh/gltf/document.hpp"

namespace pah {

class GltfBuffers {
 public:
  // Reads all buffers. Rejects accessors of more than `max_count` elements. The document must
  // outlive this. Every function throws MeshFileError.
  GltfBuffers(const GltfDocument& document, std::uint64_t max_count);

  [[nodiscard]] std::string_view view(std::size_t index) const;

  // Returns elements of `components` numbers, one element after another. Elements without data are
  // 0, as in sparse accessors. `name` is for errors.
  [[nodiscard]] std::vector<float> floats(std::size_t accessor, std::size_t components,
                                          const std::string& name) const;
  // Returns the numbers in an element: 3 for "VEC3".
  [[nodiscard]] std::size_t components(std::size_t accessor) const;
  // Returns elements of one whole number.
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
