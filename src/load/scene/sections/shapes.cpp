#include "load/scene/sections/shapes.hpp"

#include "image/image_header.hpp"

namespace pah {
namespace {

constexpr int most_round = 65536;   // segments of shapes that are round in one direction
constexpr int most_patched = 8192;  // and in two directions
constexpr std::uint64_t most_heights = 1ULL << 31U;

void read_keys(MapReader& map, RectangleShape& shape) {
  map.optional("size", shape.size, positive);
}

void read_keys(MapReader& map, DiskShape& shape) {
  map.optional("radius", shape.radius, positive);
  map.optional("segments", shape.segments, 3, most_round);
}

void read_keys(MapReader& map, BoxShape& shape) { map.optional("size", shape.size, positive); }

void read_keys(MapReader& map, SphereShape& shape) {
  map.optional("radius", shape.radius, positive);
  map.optional("segments", shape.segments, 3, most_patched);
  map.optional("rings", shape.rings, 2, most_patched);
}

void read_keys(MapReader& map, CylinderShape& shape) {
  map.optional("radius", shape.radius, positive);
  map.optional("height", shape.height, positive);
  map.optional("segments", shape.segments, 3, most_round);
  map.optional("capped", shape.capped);
}

void read_keys(MapReader& map, ConeShape& shape) {
  map.optional("radius", shape.radius, positive);
  map.optional("height", shape.height, positive);
  map.optional("segments", shape.segments, 3, most_round);
  map.optional("capped", shape.capped);
}

void read_keys(MapReader& map, TorusShape& shape) {
  map.optional("radius", shape.radius, positive);
  const bool given = map.optional("tube_radius", shape.tube_radius, positive);
  if (shape.tube_radius > shape.radius)
    map.error(given ? "tube_radius" : "radius",
              map.name_of("tube_radius") + " must not be larger than the radius");
  map.optional("segments", shape.segments, 3, most_patched);
  map.optional("tube_segments", shape.tube_segments, 3, most_patched);
}

bool read_height_image(SceneReading& reading, MapReader& map, const YamlNode& node,
                       HeightFieldShape& shape) {
  const ValueName name = map.name_of("image");
  const auto file = reading.files.open(reading.context, node, name, reading.limits.image_bytes);
  if (!file) return false;
  const std::string shown = "image '" + file->filename().string() + "'";
  try {
    const auto [width, height] = read_image_header(*file, reading.limits.image_bytes);
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<unsigned>(height);
    if (width < 2 || height < 2 || pixels > most_heights / 2 ||
        pixels * 2 > reading.limits.triangles) {
      map.error("image", shown + " has " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels: too few or too many for heights");
      return false;
    }
    shape.columns = width;
    shape.rows = height;
    shape.heights = read_first_channel(*file, reading.limits.image_bytes);
    return true;
  } catch (const FileError& error) {
    map.error("image", "cannot read " + shown + ": " + error.what());
    return false;
  }
}

bool read_height_rows(MapReader& map, const YamlNode& node, HeightFieldShape& shape) {
  const ValueName name = map.name_of("heights");
  if (!is_list(map.context(), node, name)) return false;
  for (const YamlRef& row : node.items) {
    if (!is_list(map.context(), *row, "a row of " + name)) return false;
    if (row->items.size() != node.items.front()->items.size()) {
      map.context().errors.add(row->mark, "the rows of " + name + " must be of one length");
      return false;
    }
    for (const YamlRef& item : row->items)
      if (!read_value(map.context(), *item, name, shape.heights.emplace_back())) return false;
  }
  shape.rows = static_cast<int>(node.items.size());
  shape.columns = shape.rows == 0 ? 0 : static_cast<int>(node.items.front()->items.size());
  if (shape.rows >= 2 && shape.columns >= 2) return true;
  map.error("heights", name + " must have at least two rows of two");
  return false;
}

bool read_keys(SceneReading& reading, MapReader& map, HeightFieldShape& shape) {
  map.optional("size", shape.size, positive);
  map.optional("height", shape.height);
  const YamlNode* image = map.find("image");
  const YamlNode* heights = map.find("heights");
  if (map.recording()) return false;
  if ((image == nullptr) == (heights == nullptr)) {
    map.context().errors.add(map.mark(), map.title() + " takes either 'image' or 'heights'");
    return false;
  }
  return image != nullptr ? read_height_image(reading, map, *image, shape)
                          : read_height_rows(map, *heights, shape);
}

// An upper bound of the triangles that make_mesh() makes.
struct TriangleBound {
  std::uint64_t operator()(const RectangleShape&) const { return 2; }
  std::uint64_t operator()(const BoxShape&) const { return 12; }
  std::uint64_t operator()(const DiskShape& s) const { return patches(s.segments, 1); }
  std::uint64_t operator()(const SphereShape& s) const { return patches(s.segments, s.rings); }
  std::uint64_t operator()(const CylinderShape& s) const { return patches(s.segments, 2); }
  std::uint64_t operator()(const ConeShape& s) const { return patches(s.segments, 1); }
  std::uint64_t operator()(const TorusShape& s) const {
    return patches(s.segments, s.tube_segments);
  }
  std::uint64_t operator()(const HeightFieldShape& s) const { return patches(s.columns, s.rows); }

 private:
  static std::uint64_t patches(int a, int b) {
    return 2 * static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b);
  }
};

template <std::size_t Index = 0>
Shape default_shape(std::size_t index) {
  if constexpr (Index + 1 < std::variant_size_v<Shape>) {
    if (index != Index) return default_shape<Index + 1>(index);
  }
  return std::variant_alternative_t<Index, Shape>{};
}

}  // namespace

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names{"rectangle", "disk", "box",   "sphere",
                                              "cylinder",  "cone", "torus", "height_field"};
  return names;
}

std::optional<Shape> read_shape(SceneReading& reading, MapReader& map, std::size_t index,
                                std::uint64_t most_triangles) {
  Shape shape = default_shape(index);
  bool valid = true;
  std::visit(
      [&](auto& given) {
        if constexpr (std::is_same_v<decltype(given), HeightFieldShape&>)
          valid = read_keys(reading, map, given);
        else
          read_keys(map, given);
      },
      shape);
  if (!valid) return {};
  if (std::visit(TriangleBound{}, shape) <= most_triangles) return shape;
  map.error("shape", map.title() + " brings the scene to more than " +
                         std::to_string(reading.limits.triangles) + " triangles");
  return {};
}

}  // namespace pah
