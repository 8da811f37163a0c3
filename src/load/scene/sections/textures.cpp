// The textures section, and colors and scalars that a texture may replace.
#include <algorithm>

#include "image/srgb.hpp"
#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

std::optional<std::filesystem::path> open_image(SceneReading& reading, const YamlNode& node,
                                                const ValueName& name) {
  auto file = reading.files.open(reading.context, node, name, reading.limits.image_bytes);
  if (file) reading.pictures.emplace(*file, NamedPicture{node.mark});
  return file;
}

TextureId add_texture(Scene& scene, Texture texture) {
  scene.textures.push_back(std::move(texture));
  return static_cast<TextureId>(scene.textures.size() - 1);
}

TextureId shared_image(SceneReading& reading, const ImageTexture& image) {
  const std::string key = std::to_string(static_cast<int>(image.color_space)) + image.file.string();
  const auto [entry, is_new] = reading.images.emplace(key, no_texture);
  if (is_new) entry->second = add_texture(reading.scene, image);
  return entry->second;
}

// Returns the texture for use as numbers: without a declared color space, an image is then linear.
TextureId as_numbers(SceneReading& reading, TextureId id) {
  const auto* image = std::get_if<ImageTexture>(&reading.scene.textures[id]);
  if (image == nullptr || image->color_space != ColorSpace::automatic) return id;
  const auto [entry, is_new] = reading.linear_copies.emplace(id, no_texture);
  if (is_new) {
    ImageTexture linear = *image;
    linear.color_space = ColorSpace::linear;
    entry->second = add_texture(reading.scene, linear);
  }
  return entry->second;
}

// Reads the keys `texture` and `image` of a map, which must have exactly one of them.
TextureId read_source(SceneReading& reading, MapReader& map, bool numbers) {
  const YamlNode* texture = map.find("texture");
  const YamlNode* image = map.find("image");
  if (map.recording()) return no_texture;
  if ((texture == nullptr) == (image == nullptr)) {
    reading.context.errors.add(map.mark(), map.title() + " takes either 'texture' or 'image'");
    return no_texture;
  }
  if (image != nullptr)
    return image_texture(reading, *image, map.name_of("image"),
                         numbers ? ColorSpace::linear : ColorSpace::automatic)
        .value_or(no_texture);
  const auto id = reading.textures.find(reading.context, *texture, map.name_of("texture"));
  if (!id || *id == no_texture) return no_texture;
  return numbers ? as_numbers(reading, *id) : *id;
}

// Reads one number for both, or one for each.
bool read_pair(MapReader& map, std::string_view key, DVec2& value) {
  const YamlNode* node = map.find(key);
  if (node == nullptr) return false;
  if (node->kind == Kind::list) return read_value(map.context(), *node, map.name_of(key), value);
  double number = 0;
  if (!read_value(map.context(), *node, map.name_of(key), number)) return false;
  value = DVec2(number);
  return true;
}

std::optional<Texture> read_image_texture(SceneReading& reading, MapReader& map) {
  ImageTexture texture;
  map.option("color_space", texture.color_space,
             EnumNames<ColorSpace>{{"auto", ColorSpace::automatic},
                                   {"srgb", ColorSpace::srgb},
                                   {"linear", ColorSpace::linear}});
  read_pair(map, "scale", texture.scale);
  map.optional("offset", texture.offset);
  map.option("wrap", texture.clamp, EnumNames<bool>{{"repeat", false}, {"clamp", true}});
  const YamlNode* file = map.find("file", true);
  if (file == nullptr) return {};
  const auto path = open_image(reading, *file, map.name_of("file"));
  if (!path) return {};
  texture.file = *path;
  return texture;
}

// "#rrggbb" to a linear color; false if it is not one. Returns whether a color holds whole numbers
// up to 255 although 1 is the maximum.
bool is_of_bytes(const YamlNode& node, const NumberRange& range) {
  if (range.max != 1) return false;
  return std::all_of(node.items.begin(), node.items.end(), [](const YamlRef& item) {
    return item->kind == Kind::scalar && !item->text.empty() && item->text.size() <= 3 &&
           item->text.find_first_not_of("0123456789") == std::string::npos;
  });
}

// Suggests {image: file} if a text looks like the name of a picture.
std::string picture_hint(const YamlNode& node) {
  const bool is_file =
      node.kind == Kind::scalar && std::filesystem::path(node.text).extension().string().size() > 3;
  return is_file ? "; a picture is {image: " + node.text + "}" : "";
}

bool parse_hex_color(const std::string& text, Vec3& value) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    return false;
  for (int i = 0; i < 3; ++i) {
    const int byte = std::stoi(text.substr(1 + 2 * static_cast<std::size_t>(i), 2), nullptr, 16);
    value[i] = static_cast<float>(linear_from_srgb(byte / 255.0));
  }
  return true;
}

}  // namespace

std::optional<TextureId> image_texture(SceneReading& reading, const YamlNode& node,
                                       const ValueName& name, ColorSpace color_space) {
  const auto path = open_image(reading, node, name);
  if (!path) return {};
  ImageTexture texture;
  texture.file = *path;
  texture.color_space = color_space;
  return shared_image(reading, texture);
}

bool read_color(ReadContext& context, const YamlNode& node, const ValueName& name, Vec3& value,
                const NumberRange& range) {
  if (node.kind == Kind::list) {
    DVec3 color{};
    const std::size_t errors = context.errors.size();
    if (!read_value(context, node, name, color, range)) {
      if (context.errors.size() > errors && is_of_bytes(node, range))
        context.errors.add(node.mark,
                           name + " goes from 0 to 1: divide by 255, or write \"#rrggbb\"");
      return false;
    }
    value = Vec3(color);
    return true;
  }
  if (node.kind == Kind::scalar && parse_hex_color(node.text, value)) return true;
  if (node.kind != Kind::scalar || !is_number(node)) {
    context.errors.add(node.mark, name + " must be a color ([r, g, b], a number or \"#rrggbb\"), " +
                                      "not " + describe(node) + picture_hint(node));
    return false;
  }
  float number = 0;
  if (!read_value(context, node, name, number, range)) return false;
  value = Vec3(number);
  return true;
}

void read_input(SceneReading& reading, MapReader& map, std::string_view key, ColorInput& input,
                const NumberRange& range) {
  map.nested(key, [&](const YamlNode* node) {
    const ValueName name = map.name_of(key);
    if (node != nullptr && node->kind != Kind::map) {
      read_color(reading.context, *node, name, input.value, range);
      return;
    }
    read_map(reading.context, node, "color texture", name, [&](MapReader& inner) {
      input.value = Vec3(1);
      input.texture = read_source(reading, inner, false);
      if (const YamlNode* scale = inner.find("scale"))
        read_color(reading.context, *scale, inner.name_of("scale"), input.value, range);
    });
  });
}

void read_input(SceneReading& reading, MapReader& map, std::string_view key, ScalarInput& input,
                const NumberRange& range) {
  map.nested(key, [&](const YamlNode* node) {
    const ValueName name = map.name_of(key);
    if (node != nullptr && node->kind != Kind::map) {
      read_value(reading.context, *node, name, input.value, range);
      return;
    }
    read_map(reading.context, node, "scalar texture", name, [&](MapReader& inner) {
      input.value = 1;
      input.texture = read_source(reading, inner, true);
      inner.optional("scale", input.value, range);
      inner.option("channel", input.channel,
                   EnumNames<int>{{"r", 0}, {"g", 1}, {"b", 2}, {"a", 3}});
    });
  });
}

void read_normal_map(SceneReading& reading, MapReader& map, std::string_view key,
                     TextureId& texture) {
  map.nested(key, [&](const YamlNode* node) {
    read_map(reading.context, node, "normal texture", map.name_of(key),
             [&](MapReader& inner) { texture = read_source(reading, inner, true); });
  });
}

void read_textures(SceneReading& reading, const YamlNode* node) {
  const auto read_one = [&](const YamlNode* value, const std::string& title) {
    std::optional<Texture> result;
    read_variant(reading.context, value, "texture", title, "type", {"image", "checker"}, 2,
                 [&](MapReader& map, std::size_t type) {
                   if (type == 0) {
                     result = read_image_texture(reading, map);
                     return;
                   }
                   CheckerTexture checker;
                   for (auto [key, color] : {std::pair{"a", &checker.a}, {"b", &checker.b}})
                     if (const YamlNode* given = map.find(key))
                       read_color(reading.context, *given, map.name_of(key), *color);
                   read_pair(map, "scale", checker.scale);
                   result = checker;
                 });
    return result;
  };
  if (node == nullptr) {
    (void)read_one(nullptr, "texture");
    return;
  }
  if (!is_map(reading.context, node, "textures")) return;
  for (const YamlEntry& entry : node->entries) {
    const auto texture = read_one(entry.value.get(), "texture '" + entry.key + "'");
    // A texture with errors keeps its name, so that its uses cause no further errors.
    const TextureId id = texture ? add_texture(reading.scene, *texture) : no_texture;
    reading.textures.add(reading.context, entry.key, id, entry.mark);
  }
}

}  // namespace pah
