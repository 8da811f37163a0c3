#include "load/mesh/gltf/document.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <pah/load/mesh_file.hpp>

#include "base/extension.hpp"
#include "base/little_endian.hpp"
#include "load/mesh/common/folder.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;

// The two chunks of a .glb.
struct Container {
  std::string_view json;
  std::string_view binary;
};

Container open_container(std::string_view bytes) {
  const auto cut = [] { throw MeshFileError("the file is cut short, or not binary glTF"); };
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") cut();
  if (load_u32(bytes.data() + 4) != 2) throw MeshFileError("only version 2 of glTF can be read");
  if (load_u32(bytes.data() + 8) > bytes.size()) cut();
  Container container;
  const std::uint32_t json_size = load_u32(bytes.data() + 12);
  if (load_u32(bytes.data() + 16) != json_chunk || json_size > bytes.size() - 20) cut();
  container.json = bytes.substr(20, json_size);
  const std::size_t next = 20 + std::size_t{json_size};
  if (next + 8 <= bytes.size() && load_u32(bytes.data() + next + 4) == binary_chunk) {
    const std::uint32_t size = load_u32(bytes.data() + next);
    if (size > bytes.size() - next - 8) cut();
    container.binary = bytes.substr(next + 8, size);
  }
  return container;
}

int line_of(std::string_view text, std::size_t at) {
  int line = 1;
  for (std::size_t i = 0; i < std::min(at, text.size()); ++i) line += text[i] == '\n' ? 1 : 0;
  return line;
}

// Returns the decoded bytes of base64 with padding, or nothing if the text is not base64.
std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    int value = 0;
    if (c >= 'A' && c <= 'Z')
      value = c - 'A';
    else if (c >= 'a' && c <= 'z')
      value = c - 'a' + 26;
    else if (c >= '0' && c <= '9')
      value = c - '0' + 52;
    else if (c == '+' || c == '/')
      value = c == '+' ? 62 : 63;
    else
      return std::nullopt;
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    if (++count % 4 == 0) {
      bytes.push_back(static_cast<char>(bits >> 16U));
      bytes.push_back(static_cast<char>(bits >> 8U));
      bytes.push_back(static_cast<char>(bits));
    }
  }
  if (count % 4 == 1) return std::nullopt;
  if (count % 4 >= 2) bytes.push_back(static_cast<char>(bits >> (count % 4 == 2 ? 4U : 10U)));
  if (count % 4 == 3) bytes.push_back(static_cast<char>(bits >> 2U));
  return bytes;
}

// Decodes percent-encoded characters, such as "%20" for a space.
std::string decode_uri(std::string_view uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      text.push_back(static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])));
      i += 2;
    } else {
      text.push_back(uri[i]);
    }
  }
  return text;
}

// Reads a whole file.
std::string read_bytes(const fs::path& file, std::uint64_t max_bytes) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw MeshFileError("there is no file '" + file.filename().string() + "'");
  const std::uint64_t size = fs::file_size(file, error);
  if (error || size > max_bytes)
    throw MeshFileError("'" + file.filename().string() + "' is larger than " +
                        std::to_string(max_bytes >> 20) + " MB");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) throw MeshFileError("'" + file.filename().string() + "' cannot be read");
  return bytes;
}

void check_required(const Json& json) {
  constexpr std::string_view known[] = {"KHR_lights_punctual",   "KHR_materials_emissive_strength",
                                        "KHR_materials_ior",     "KHR_materials_transmission",
                                        "KHR_mesh_quantization", "KHR_texture_transform"};
  for (const Json& extension : list(json, "extensionsRequired")) {
    const auto& name = extension.get_ref<const std::string&>();
    if (name.find("compression") != std::string::npos)
      throw MeshFileError("it is compressed by " + name + ", which cannot be read");
    if (std::find(std::begin(known), std::end(known), name) == std::end(known))
      throw MeshFileError("it needs " + name + ", which cannot be read");
  }
}

}  // namespace

bool is_data(const std::string& uri) { return uri.rfind("data:", 0) == 0; }

fs::path GltfDocument::path_of(const std::string& uri) const {
  const fs::path path = decode_uri(uri);
  if (path.is_absolute() || uri.find("://") != std::string::npos)
    throw MeshFileError("it names '" + uri + "', which is not a path relative to it");
  const fs::path whole = file.parent_path() / path;
  if (!lies_in(whole, folder))
    throw MeshFileError("it names '" + uri + "', which lies outside of its folder");
  return whole;
}

fs::path GltfDocument::image_of(const std::string& uri) const {
  fs::path image = path_of(uri);
  std::error_code error;
  if (!fs::is_regular_file(image, error)) throw MeshFileError("there is no image '" + uri + "'");
  return image;
}

std::string GltfDocument::data_of(const std::string& uri) const {
  if (!is_data(uri)) {
    const fs::path path = path_of(uri);
    if (on_file) on_file(path);
    return read_bytes(path, max_bytes);
  }
  const std::size_t comma = uri.find(";base64,");
  auto decoded = comma == std::string::npos
                     ? std::nullopt
                     : decode_base64(std::string_view(uri).substr(comma + 8));
  if (!decoded) throw MeshFileError("data inside of the file are not base64");
  return std::move(*decoded);
}

GltfDocument read_gltf_document(const fs::path& file, const fs::path& folder,
                                std::uint64_t max_bytes) {
  const std::string bytes = read_bytes(file, max_bytes);
  const bool binary = bytes.rfind("glTF", 0) == 0;
  if (binary != (lower_extension(file) == ".glb"))
    throw MeshFileError(binary ? "it is binary glTF, whose extension is .glb"
                               : "the file is cut short, or not binary glTF");
  const Container container = binary ? open_container(bytes) : Container{bytes, {}};
  GltfDocument document{file, folder, max_bytes, {}, std::string(container.binary)};
  try {
    document.json = Json::parse(container.json);
  } catch (const Json::parse_error& e) {
    throw MeshFileError("it is not JSON: " + std::string(e.what()),
                        binary ? 0 : line_of(container.json, e.byte));
  }
  if (!document.json.is_object()) throw MeshFileError("it is not a glTF document");
  const Json asset = document.json.value("asset", Json::object());
  if (asset.value("version", std::string()).rfind("2.", 0) != 0)
    throw MeshFileError("only version 2 of glTF can be read");
  check_required(document.json);
  return document;
}

}  // namespace pah
