// The numbers of a glTF file: buffers, views of them, accessors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "load/mesh/gltf/document.hpp"

namespace pah {

class GltfBuffers {
 public:
  // Reads all buffers. Accessors of more than `max_count` elements are refused. The document has to
  // outlive this. Throws MeshFileError, as do all that follow.
  GltfBuffers(const GltfDocument& document, std::uint64_t max_count);

  [[nodiscard]] std::string_view view(std::size_t index) const;

  // Elements of `components` numbers, one element after the other; what an accessor without data or
  // a sparse one leaves open is 0. `name` is for errors.
  [[nodiscard]] std::vector<float> floats(std::size_t accessor, std::size_t components,
                                          const std::string& name) const;
  // How many numbers an element has: "VEC3" are 3.
  [[nodiscard]] std::size_t components(std::size_t accessor) const;
  // Whole numbers.
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
