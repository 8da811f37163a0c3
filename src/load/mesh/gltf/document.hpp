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
  std::filesystem::path folder;  // in or under which all files that it names have to lie
  std::uint64_t max_bytes = 0;   // of each of them
  Json json;
  std::string binary;                                              // the binary chunk of a .glb
  std::function<void(const std::filesystem::path&)> on_file = {};  // as MeshFileOptions::on_file

  // The file that a URI names. Throws MeshFileError if it lies elsewhere.
  [[nodiscard]] std::filesystem::path path_of(const std::string& uri) const;
  // The image that a URI names. Throws MeshFileError if it does not exist.
  [[nodiscard]] std::filesystem::path image_of(const std::string& uri) const;
  // The data of a "data:" URI, or of the file that another one names. Throws MeshFileError.
  [[nodiscard]] std::string data_of(const std::string& uri) const;
};

// Reads the document. Throws MeshFileError, also if the file requires an extension that cannot be
// read.
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& file,
                                              const std::filesystem::path& folder,
                                              std::uint64_t max_bytes);

[[nodiscard]] bool is_data(const std::string& uri);

}  // namespace pah
