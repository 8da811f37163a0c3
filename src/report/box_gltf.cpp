#include "report/box_gltf.hpp"

#include <algorithm>
#include <bit>
#include <pah/bvh/analyze.hpp>

#include "report/false_color.hpp"
#include "report/json_value.hpp"

namespace pah {
namespace {

// Numbers of the glTF 2.0 specification.
enum class Gltf { lines = 1, unsigned_int = 5125, float32 = 5126, array = 34962, elements = 34963 };
int number(Gltf value) { return static_cast<int>(value); }

constexpr std::size_t corners = 8;
constexpr std::size_t edge_ends = 24;

// Little-endian, as the specification asks for.
void append(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(word >> shift & 0xFFU));
}

// Bit k of a corner's number tells whether it lies at the maximum of axis k.
void append_corners(std::string& bytes, const Aabb& box) {
  for (std::uint32_t corner = 0; corner < corners; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      append(bytes, std::bit_cast<std::uint32_t>((corner >> axis & 1U) != 0 ? box.max[axis]
                                                                            : box.min[axis]));
}

// Corners that differ in one bit are joined.
void append_edges(std::string& bytes, std::uint32_t box) {
  for (std::uint32_t corner = 0; corner < corners; ++corner)
    for (std::uint32_t bit = 1; bit < corners; bit *= 2)
      if ((corner & bit) == 0) {
        append(bytes, box * corners + corner);
        append(bytes, box * corners + (corner | bit));
      }
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

std::vector<JsonValue> numbers(const Vec3& v) { return {v.x, v.y, v.z}; }

struct Level {
  std::string positions;
  Aabb bounds;
  std::size_t boxes = 0;
};

std::vector<Level> levels_of(const BinaryTree& tree, std::uint32_t count) {
  std::vector<Level> levels;
  const auto add = [&](const NodeVisit& visit) {
    if (visit.depth >= count) return;
    if (visit.depth == levels.size()) levels.emplace_back();
    Level& level = levels[visit.depth];
    append_corners(level.positions, visit.node().box);
    level.bounds.extend(visit.node().box);
    ++level.boxes;
  };
  return visit_tree(tree, add, [&] { return std::move(levels); });
}

JsonValue material(std::size_t level, std::size_t levels) {
  // Neither black nor white: it is to be seen on both.
  const double value = 0.25 + 0.5 * static_cast<double>(level) /
                                  static_cast<double>(std::max<std::size_t>(levels - 1, 1));
  std::vector<JsonValue> color = numbers(false_color(value));
  color.emplace_back(1);
  return {{"pbrMetallicRoughness", {{"baseColorFactor", color}, {"metallicFactor", 0}}},
          {"extensions", {{"KHR_materials_unlit", JsonValue::object()}}}};
}

}  // namespace

std::string boxes_gltf(const BinaryTree& tree, std::uint32_t count, const DVec3& origin) {
  const std::vector<Level> levels = levels_of(tree, count);
  using Array = std::vector<JsonValue>;
  JsonValue root{{"name", "BVH"}, {"translation", Array{origin.x, origin.y, origin.z}}};
  JsonValue json{{"asset", {{"version", "2.0"}, {"generator", "pahrender"}}},
                 {"scene", 0},
                 {"scenes", JsonValue::array({{{"nodes", JsonValue::array({0})}}})}};
  if (levels.empty()) {
    json.set("nodes", JsonValue::array({root}));
    return json.text() + "\n";
  }

  // Edges first: those of n boxes are the first of those of more, so that all levels share them.
  std::size_t most_boxes = 0;
  for (const Level& level : levels) most_boxes = std::max(most_boxes, level.boxes);
  std::string bytes;
  for (std::uint32_t box = 0; box < most_boxes; ++box) append_edges(bytes, box);
  Array views{{{"buffer", 0}, {"byteLength", bytes.size()}, {"target", number(Gltf::elements)}}};
  Array nodes, meshes, materials, accessors, children;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Level& level = levels[i];
    const std::string name = "level " + std::to_string(i);
    views.push_back({{"buffer", 0},
                     {"byteOffset", bytes.size()},
                     {"byteLength", level.positions.size()},
                     {"target", number(Gltf::array)}});
    bytes += level.positions;
    accessors.push_back({{"bufferView", 0},
                         {"componentType", number(Gltf::unsigned_int)},
                         {"count", edge_ends * level.boxes},
                         {"type", "SCALAR"}});
    accessors.push_back({{"bufferView", i + 1},
                         {"componentType", number(Gltf::float32)},
                         {"count", corners * level.boxes},
                         {"type", "VEC3"},
                         {"min", numbers(level.bounds.min)},
                         {"max", numbers(level.bounds.max)}});
    const JsonValue primitive{{"attributes", {{"POSITION", 2 * i + 1}}},
                              {"indices", 2 * i},
                              {"material", i},
                              {"mode", number(Gltf::lines)}};
    meshes.push_back({{"name", name}, {"primitives", JsonValue::array({primitive})}});
    materials.push_back(material(i, levels.size()));
    nodes.push_back({{"name", name}, {"mesh", i}});
    children.emplace_back(i + 1);
  }
  root.set("children", children);
  nodes.insert(nodes.begin(), root);
  json.set("extensionsUsed", JsonValue::array({"KHR_materials_unlit"}));
  json.set("nodes", nodes);
  json.set("meshes", meshes);
  json.set("materials", materials);
  json.set("accessors", accessors);
  json.set("bufferViews", views);
  json.set("buffers",
           JsonValue::array({{{"byteLength", bytes.size()},
                              {"uri", "data:application/octet-stream;base64," + base64(bytes)}}}));
  return json.text() + "\n";
}

}  // namespace pah
