// Textures made ready for look-ups; images through OpenImageIO's TextureSystem.
#pragma once

#include <cstdint>
#include <memory>
#include <pah/image/image.hpp>
#include <pah/image/texture.hpp>
#include <span>
#include <stdexcept>
#include <string>

namespace pah {

// A texture that cannot be used; what() names the file.
class TextureError : public std::runtime_error {
 public:
  TextureError(TextureId id, const std::string& message) : std::runtime_error(message), id_(id) {}
  [[nodiscard]] TextureId id() const { return id_; }

 private:
  TextureId id_;
};

struct TextureOptions {
  std::uint64_t max_image_bytes = 4ULL << 30;  // of one decoded image, as RGB floats
  int cache_megabytes = 1024;                  // tiles held in memory
};

// What a look-up is for. Images whose encoding is not declared hold plain numbers if they are used
// as data: roughness, opacity, normals.
enum class TextureUse { color, data };

// Look-ups are thread-safe and do not throw. Colors are linear Rec. 709.
class TextureStore {
 public:
  // Opens every image and checks its size before anything is decoded. Throws TextureError.
  explicit TextureStore(std::span<const Texture> textures, const TextureOptions& options = {});
  ~TextureStore();
  TextureStore(TextureStore&&) noexcept;
  TextureStore& operator=(TextureStore&&) noexcept;

  // The texture about (u, v), v = 0 being the image's bottom row, averaged over a footprint given
  // in texture coordinates (0: the finest level, interpolated). Images without alpha have alpha 1;
  // one-channel images are gray. What is not finite in the file is 0. Where the file fails to
  // decode, or the coordinates are not finite: black.
  [[nodiscard]] Vec4 sample(TextureId id, Vec2 uv, TextureUse use = TextureUse::color,
                            Vec2 footprint = Vec2{0}) const noexcept;

  // value times the texture, if there is one.
  [[nodiscard]] Vec3 color(const ColorInput& input, Vec2 uv, float footprint = 0) const noexcept;
  [[nodiscard]] float scalar(const ScalarInput& input, Vec2 uv, float footprint = 0) const noexcept;

  // The whole image, without scale and offset. Throws TextureError if it cannot be decoded or is no
  // image.
  [[nodiscard]] Image image(TextureId id) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
