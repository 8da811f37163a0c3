// A glTF 2.0 file, text or binary: its JSON, and access to the files that the JSON names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "load/mesh/gltf/json.hpp"

namespace pah {

struct GltfDocument {
  std::filesystem::path file;
  std::filesystem::path folder;  // all files that it names must lie in or under it
  std::uint64_t max_bytes = 0;   // of each file
  Json json;
  std::string binary;                                              // the binary chunk of a .glb
  std::function<void(const std::filesystem::path&)> on_file = {};  // like MeshFileOptions::on_file

  // Returns the path of the file that a URI names. Throws MeshFileError if it lies elsewhere.
  [[nodiscard]] std::filesystem::path path_of(const std::string& uri) const;
  // The image that a URI names. Throws MeshFileError if it does not exist.
  [[nodiscard]] std::filesystem::path image_of(const std::string& uri) const;
  // Returns the data of a "data:" URI, or of the file that another URI names. Throws MeshFileError.
  [[nodiscard]] std::string data_of(const std::string& uri) const;
};

// Reads the document. Throws MeshFileError, also if the file requires an extension that cannot be
// read.
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& file,
                                              const std::filesystem::path& folder,
                                              std::uint64_t max_bytes);

[[nodiscard]] bool is_data(const std::string& uri);

}  // namespace pah
