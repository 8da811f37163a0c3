#include "report/inspect/pictures/line_gltf.hpp"

#include <algorithm>
#include <bit>

#include "report/json_value.hpp"

namespace pah {
namespace {

// Numbers of the glTF 2.0 specification.
enum class Gltf { lines = 1, unsigned_int = 5125, float32 = 5126, array = 34962, elements = 34963 };
int number(Gltf value) { return static_cast<int>(value); }

// Little-endian, as the specification asks for.
void append(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(word >> shift & 0xFFU));
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=');
  }
  return text;
}

using Array = std::vector<JsonValue>;

Array numbers(const Vec3& v) { return {v.x, v.y, v.z}; }

JsonValue material(const Vec3& color) {
  Array factor = numbers(color);
  factor.emplace_back(1);
  return {{"pbrMetallicRoughness", {{"baseColorFactor", factor}, {"metallicFactor", 0}}},
          {"extensions", {{"KHR_materials_unlit", JsonValue::object()}}}};
}

class Writer {
 public:
  // The index of its node.
  std::size_t add(const LineGroup& group) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{"name", group.name}});
    Array children;
    for (const LineSet& set : group.sets) children.emplace_back(add(set));
    for (const LineGroup& below : group.groups) children.emplace_back(add(below));
    if (!children.empty()) nodes_[index].set("children", children);
    return index;
  }

  [[nodiscard]] std::string text(const DVec3& origin) {
    nodes_.front().set("translation", Array{origin.x, origin.y, origin.z});
    JsonValue json{{"asset", {{"version", "2.0"}, {"generator", "pahrender"}}},
                   {"scene", 0},
                   {"scenes", JsonValue::array({{{"nodes", JsonValue::array({0})}}})},
                   {"nodes", nodes_}};
    if (!meshes_.empty()) {  // the specification has no empty arrays
      const std::string uri = "data:application/octet-stream;base64," + base64(bytes_);
      json.set("extensionsUsed", JsonValue::array({"KHR_materials_unlit"}));
      json.set("meshes", meshes_);
      json.set("materials", materials_);
      json.set("accessors", accessors_);
      json.set("bufferViews", views_);
      json.set("buffers", JsonValue::array({{{"byteLength", bytes_.size()}, {"uri", uri}}}));
    }
    return json.text() + "\n";
  }

 private:
  std::size_t add(const LineSet& set) {
    std::string edges, positions;
    for (const auto& ends : set.edges)
      for (const std::uint32_t end : ends) append(edges, end);
    Aabb bounds;
    for (const Vec3& position : set.positions) {
      bounds.extend(position);
      for (int axis = 0; axis < 3; ++axis)
        append(positions, std::bit_cast<std::uint32_t>(position[axis]));
    }
    accessors_.push_back({{"bufferView", add_view(edges, Gltf::elements)},
                          {"componentType", number(Gltf::unsigned_int)},
                          {"count", 2 * set.edges.size()},
                          {"type", "SCALAR"}});
    accessors_.push_back({{"bufferView", add_view(positions, Gltf::array)},
                          {"componentType", number(Gltf::float32)},
                          {"count", set.positions.size()},
                          {"type", "VEC3"},
                          {"min", numbers(bounds.min)},
                          {"max", numbers(bounds.max)}});
    const JsonValue primitive{{"attributes", {{"POSITION", accessors_.size() - 1}}},
                              {"indices", accessors_.size() - 2},
                              {"material", materials_.size()},
                              {"mode", number(Gltf::lines)}};
    nodes_.push_back({{"name", set.name}, {"mesh", meshes_.size()}});
    meshes_.push_back({{"name", set.name}, {"primitives", JsonValue::array({primitive})}});
    materials_.push_back(material(set.color));
    return nodes_.size() - 1;
  }

  std::size_t add_view(const std::string& bytes, Gltf target) {
    views_.push_back({{"buffer", 0},
                      {"byteOffset", bytes_.size()},
                      {"byteLength", bytes.size()},
                      {"target", number(target)}});
    bytes_ += bytes;
    return views_.size() - 1;
  }

  Array nodes_, meshes_, materials_, accessors_, views_;
  std::string bytes_;
};

}  // namespace

std::string lines_gltf(const LineGroup& root, const DVec3& origin) {
  Writer writer;
  writer.add(root);
  return writer.text(origin);
}

}  // namespace pah
