#include "io/mesh/gltf_check.hpp"

#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/folder.hpp"
#include "io/mesh/gltf.hpp"
#include "io/mesh/little_endian.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int max_depth = 256;  // of nodes below nodes

// Of base64, padding and all; nothing if it is not that.
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

struct Accessor {
  std::uint64_t count = 0;
  int component_type = 0;
  std::string type;
  std::string_view bytes;  // from its first element on
  std::uint64_t stride = 0;
};

class GltfCheck {
 public:
  GltfCheck(const Json& json, std::string_view binary, fs::path file, fs::path folder,
            std::uint64_t max_bytes)
      : json_(json),
        binary_(binary),
        file_(std::move(file)),
        folder_(std::move(folder)),
        max_bytes_(max_bytes) {}

  void run() {
    check_version();
    read_buffers();
    read_views();
    read_accessors();
    check_meshes();
    check_nodes();
    for (const Json& image : list("images"))
      if (image.contains("uri") && !is_data(image.at("uri").get_ref<const std::string&>()))
        (void)path_of(image.at("uri").get_ref<const std::string&>());
  }

 private:
  [[nodiscard]] const Json& list(const char* key) const {
    static const Json none = Json::array();
    const auto found = json_.find(key);
    if (found == json_.end()) return none;
    if (!found->is_array()) throw MeshFileError(std::string("'") + key + "' is not a list");
    return *found;
  }

  // A count or an offset; `otherwise` where there is none.
  static std::uint64_t number(const Json& object, const char* key, std::uint64_t otherwise) {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > (1ULL << 48))
      throw MeshFileError(std::string("'") + key + "' is not a sensible number");
    return found->get<std::uint64_t>();
  }

  // An index in a list of `size`.
  static std::size_t index(const Json& object, const char* key, std::size_t size) {
    const std::uint64_t value = number(object, key, UINT64_MAX);
    if (value >= size)
      throw MeshFileError(std::string("'") + key + "' names number " +
                          (value == UINT64_MAX ? "none" : std::to_string(value)) + " of " +
                          std::to_string(size));
    return value;
  }

  static bool is_data(const std::string& uri) { return uri.rfind("data:", 0) == 0; }

  [[nodiscard]] fs::path path_of(const std::string& uri) const {
    const fs::path path = decode_uri(uri);
    if (path.is_absolute() || uri.find("://") != std::string::npos)
      throw MeshFileError("it names '" + uri + "', which is not a path relative to it");
    const fs::path whole = file_.parent_path() / path;
    if (!lies_in(whole, folder_))
      throw MeshFileError("it names '" + uri + "', which lies outside of its folder");
    return whole;
  }

  void check_version() const {
    const Json asset = json_.value("asset", Json::object());
    if (asset.value("version", std::string()).rfind("2.", 0) != 0)
      throw MeshFileError("only version 2 of glTF can be read");
  }

  void read_buffers() {
    for (const Json& buffer : list("buffers")) {
      const std::uint64_t length = number(buffer, "byteLength", 0);
      std::string_view bytes = binary_;
      if (buffer.contains("uri")) {
        const auto& uri = buffer.at("uri").get_ref<const std::string&>();
        if (is_data(uri)) {
          const std::size_t comma = uri.find(";base64,");
          auto decoded = comma == std::string::npos
                             ? std::nullopt
                             : decode_base64(std::string_view(uri).substr(comma + 8));
          if (!decoded) throw MeshFileError("a buffer's data are not base64");
          owned_.push_back(std::move(*decoded));
        } else {
          owned_.push_back(read_bytes(path_of(uri), max_bytes_));
        }
        bytes = owned_.back();
      }
      if (bytes.size() < length)
        throw MeshFileError("buffer " + std::to_string(buffers_.size()) + " has " +
                            std::to_string(bytes.size()) + " bytes of " + std::to_string(length));
      buffers_.push_back(bytes.substr(0, length));
    }
  }

  void read_views() {
    for (const Json& view : list("bufferViews")) {
      const std::string_view buffer = buffers_[index(view, "buffer", buffers_.size())];
      const std::uint64_t offset = number(view, "byteOffset", 0);
      const std::uint64_t length = number(view, "byteLength", 0);
      if (offset + length > buffer.size())
        throw MeshFileError("buffer view " + std::to_string(views_.size()) +
                            " goes beyond its buffer");
      views_.push_back(buffer.substr(offset, length));
      strides_.push_back(number(view, "byteStride", 0));
    }
  }

  void read_accessors() {
    for (const Json& item : list("accessors")) {
      const std::string name = "accessor " + std::to_string(accessors_.size());
      Accessor accessor;
      accessor.count = number(item, "count", 0);
      accessor.component_type = static_cast<int>(number(item, "componentType", 0));
      accessor.type = item.value("type", std::string());
      if (item.contains("sparse") || !item.contains("bufferView"))
        throw MeshFileError(name + " is sparse or without data, which cannot be read");
      const std::size_t view = index(item, "bufferView", views_.size());
      const std::uint64_t size =
          components(accessor.type, name) * component_size(accessor.component_type, name);
      accessor.stride = strides_[view] == 0 ? size : strides_[view];
      const std::uint64_t offset = number(item, "byteOffset", 0);
      if (accessor.count == 0 || accessor.stride < size || accessor.stride > 65536 ||
          accessor.count > views_[view].size() ||
          offset + (accessor.count - 1) * accessor.stride + size > views_[view].size())
        throw MeshFileError(name + " is empty or goes beyond its buffer view");
      accessor.bytes = views_[view].substr(offset);
      accessors_.push_back(accessor);
    }
  }

  static std::uint64_t components(const std::string& type, const std::string& name) {
    constexpr std::pair<const char*, int> types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3},
                                                     {"VEC4", 4},   {"MAT2", 4}, {"MAT3", 9},
                                                     {"MAT4", 16}};
    for (const auto& [known, count] : types)
      if (type == known) return static_cast<std::uint64_t>(count);
    throw MeshFileError(name + " is of an unknown type");
  }

  static std::uint64_t component_size(int type, const std::string& name) {
    switch (type) {
      case 5120:
      case 5121:
        return 1;
      case 5122:
      case 5123:
        return 2;
      case 5125:
      case 5126:
        return 4;
      default:
        throw MeshFileError(name + " has an unknown component type");
    }
  }

  void check_meshes() const {
    for (const Json& mesh : list("meshes"))
      for (const Json& primitive : mesh.value("primitives", Json::array())) {
        const Json attributes = primitive.value("attributes", Json::object());
        if (!attributes.contains("POSITION"))
          throw MeshFileError("a mesh primitive has no positions");
        const std::uint64_t count =
            accessors_[index(attributes, "POSITION", accessors_.size())].count;
        for (const auto& [key, value] : attributes.items())
          check_attribute(key, accessors_[index(attributes, key.c_str(), accessors_.size())],
                          count);
        if (primitive.contains("indices"))
          check_indices(accessors_[index(primitive, "indices", accessors_.size())], count);
      }
  }

  static void check_attribute(const std::string& key, const Accessor& accessor,
                              std::uint64_t count) {
    if (accessor.count != count)
      throw MeshFileError("attribute " + key + " has " + std::to_string(accessor.count) +
                          " values for " + std::to_string(count) + " vertices");
    const char* const type = key == "TEXCOORD_0" ? "VEC2" : "VEC3";
    if (accessor.type != type || accessor.component_type != 5126)
      throw MeshFileError("attribute " + key + " is not of 32-bit floats");
  }

  static void check_indices(const Accessor& accessor, std::uint64_t count) {
    const int type = accessor.component_type;
    if (accessor.type != "SCALAR" || (type != 5121 && type != 5123 && type != 5125))
      throw MeshFileError("the indices of a mesh are not whole numbers");
    for (std::uint64_t i = 0; i < accessor.count; ++i) {
      const std::size_t at = i * accessor.stride;
      const auto byte = [&](std::size_t k) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(accessor.bytes[at + k]));
      };
      const std::uint32_t vertex = type == 5121   ? byte(0)
                                   : type == 5123 ? byte(0) | byte(1) << 8U
                                                  : load_u32(accessor.bytes.data() + at);
      if (vertex >= count)
        throw MeshFileError("index " + std::to_string(i) + " of a mesh names vertex " +
                            std::to_string(vertex) + " of " + std::to_string(count));
    }
  }

  // Every node hangs below one other at most, so following children ends; and not too deep.
  void check_nodes() const {
    const Json& nodes = list("nodes");
    std::vector<std::size_t> parent(nodes.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const Json& child : nodes[i].value("children", Json::array())) {
        if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= nodes.size())
          throw MeshFileError("node " + std::to_string(i) +
                              " has a child that is no node of the file");
        std::size_t& above = parent[child.get<std::size_t>()];
        if (above != nodes.size())
          throw MeshFileError("node " + child.dump() + " has more than one parent");
        above = i;
      }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      int depth = 0;
      for (std::size_t at = i; at != nodes.size(); at = parent[at])
        if (++depth > max_depth)
          throw MeshFileError("the nodes are nested in a circle, or more than " +
                              std::to_string(max_depth) + " deep");
    }
  }

  const Json& json_;
  std::string_view binary_;
  fs::path file_;
  fs::path folder_;
  std::uint64_t max_bytes_;
  std::deque<std::string> owned_;  // does not move its strings
  std::vector<std::string_view> buffers_;
  std::vector<std::string_view> views_;
  std::vector<std::uint64_t> strides_;
  std::vector<Accessor> accessors_;
};

}  // namespace

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

void check_gltf(const Json& json, std::string_view binary, const fs::path& file,
                const fs::path& folder, std::uint64_t max_bytes) {
  GltfCheck(json, binary, file, folder, max_bytes).run();
}

}  // namespace pah
