// Textures, as values. Materials and lights refer to them by TextureId, an index in
// Scene::textures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <pah/geometry/vec.hpp>
#include <string>
#include <variant>

namespace pah {

using TextureId = std::uint32_t;
inline constexpr TextureId no_texture = 0xFFFFFFFFU;

enum class ColorSpace {
  automatic,  // sRGB for 8- and 16-bit integer color images, else linear
  srgb,
  linear
};

struct ImageTexture {
  std::filesystem::path file;
  ColorSpace color_space = ColorSpace::automatic;
  DVec2 scale{1, 1};  // texture coordinates are multiplied by scale, then offset is added
  DVec2 offset{0, 0};
  bool clamp = false;  // otherwise the image repeats
  // If the picture is embedded in another file: its bytes (PNG, JPEG or WebP), and `file` is its
  // name only.
  std::shared_ptr<const std::string> bytes{};
};

// A checkerboard in texture coordinates: one square per unit of scaled coordinates.
struct CheckerTexture {
  Vec3 a{0.8F};
  Vec3 b{0.2F};
  DVec2 scale{8, 8};
};

using Texture = std::variant<ImageTexture, CheckerTexture>;

// A linear Rec. 709 color: value times the texture, if there is one.
struct ColorInput {
  Vec3 value{1};
  TextureId texture = no_texture;
};

// A scalar: value times one channel (0 red .. 3 alpha) of the texture, if there is one.
struct ScalarInput {
  float value = 1;
  TextureId texture = no_texture;
  int channel = 0;
};

}  // namespace pah
