#include "io/mesh/gltf.hpp"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/extension.hpp"
#include "io/mesh/gltf_check.hpp"
#include "io/mesh/little_endian.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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

void keep_keys(Json& object, std::initializer_list<std::string_view> keys) {
  for (auto it = object.begin(); it != object.end();) {
    bool keeps = false;
    for (const std::string_view key : keys) keeps |= it.key() == key;
    it = keeps ? std::next(it) : object.erase(it);
  }
}

// What a still picture needs: no skins, morphs and animations, whose faults the importer does not
// survive, and no cameras and lights, which are read here.
void clean(Json& json) {
  keep_keys(json, {"asset", "scene", "scenes", "nodes", "meshes", "materials", "textures", "images",
                   "samplers", "buffers", "bufferViews", "accessors", "extensionsUsed"});
  const auto each = [&json](const char* key, const auto& visit) {
    const auto found = json.find(key);
    if (found == json.end()) return;
    if (!found->is_array()) throw MeshFileError(std::string("'") + key + "' is not a list");
    for (Json& item : *found) {
      if (!item.is_object()) throw MeshFileError(std::string("'") + key + "' holds no objects");
      visit(item);
    }
  };
  each("nodes", [](Json& node) {
    keep_keys(node, {"name", "mesh", "children", "matrix", "translation", "rotation", "scale"});
  });
  each("meshes", [](Json& mesh) {
    keep_keys(mesh, {"name", "primitives"});
    for (Json& primitive : mesh.at("primitives")) {
      keep_keys(primitive, {"attributes", "indices", "material", "mode"});
      keep_keys(primitive.at("attributes"), {"POSITION", "NORMAL", "TEXCOORD_0"});
    }
  });
  if (const auto used = json.find("extensionsUsed"); used != json.end()) {
    Json kept = Json::array();
    for (const Json& name : *used)
      if (name != "KHR_lights_punctual") kept.push_back(name);
    *used = std::move(kept);
  }
}

void check_extensions(const Json& json) {
  const auto required = json.find("extensionsRequired");
  if (required == json.end()) return;
  for (const Json& extension : *required) {
    const auto& name = extension.get_ref<const std::string&>();
    if (name.find("compression") != std::string::npos ||
        name.find("quantization") != std::string::npos)
      throw MeshFileError("it is compressed by " + name + ", which cannot be read");
  }
}

void append_u32(std::string& bytes, std::size_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(value >> shift));
}

std::string pack(std::string json, std::string_view binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t padding = (4 - binary.size() % 4) % 4;
  std::string bytes = "glTF";
  append_u32(bytes, 2);
  append_u32(bytes, 28 + json.size() + binary.size() + padding);
  append_u32(bytes, json.size());
  append_u32(bytes, json_chunk);
  bytes += json;
  append_u32(bytes, binary.size() + padding);
  append_u32(bytes, binary_chunk);
  bytes += binary;
  bytes.append(padding, '\0');
  return bytes;
}

}  // namespace

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

GltfDocument read_gltf_document(const fs::path& file, const fs::path& folder,
                                std::uint64_t max_bytes) {
  const std::string bytes = read_bytes(file, max_bytes);
  const bool binary = bytes.rfind("glTF", 0) == 0;
  if (binary != (lower_extension(file) == ".glb"))
    throw MeshFileError(binary ? "it is binary glTF, whose extension is .glb"
                               : "the file is cut short, or not binary glTF");
  const Container container = binary ? open_container(bytes) : Container{bytes, {}};
  Json json;
  try {
    json = Json::parse(container.json);
  } catch (const Json::parse_error& e) {
    throw MeshFileError("it is not JSON: " + std::string(e.what()),
                        binary ? 0 : line_of(container.json, e.byte));
  }
  if (!json.is_object()) throw MeshFileError("it is not a glTF document");
  try {
    GltfDocument document;
    Json nodes = Json::object();
    for (const char* key : {"cameras", "extensions", "nodes", "scenes", "scene"})
      if (json.contains(key)) nodes[key] = json[key];
    document.nodes = std::make_shared<const Json>(std::move(nodes));
    check_extensions(json);
    clean(json);
    check_gltf(json, container.binary, file, folder, max_bytes);
    document.cleaned = binary ? pack(json.dump(), container.binary) : json.dump();
    return document;
  } catch (const Json::exception&) {
    throw MeshFileError("a value in it is not of the kind that glTF asks for");
  }
}

}  // namespace pah
