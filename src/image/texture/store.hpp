// Textures ready for look-ups. Images use OpenImageIO's TextureSystem.
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

// The use of a look-up. Images without a declared encoding hold linear numbers if used as data,
// such as roughness, opacity or normals.
enum class TextureUse { color, data };

// Look-ups are thread-safe and do not throw. Colors are linear Rec. 709.
class TextureStore {
 public:
  // Opens every image and checks its size before decoding. Throws TextureError.
  explicit TextureStore(std::span<const Texture> textures, const TextureOptions& options = {});
  ~TextureStore();
  TextureStore(TextureStore&&) noexcept;
  TextureStore& operator=(TextureStore&&) noexcept;

  // Returns the texture at (u, v), where v = 0 is the image's bottom row, averaged over a footprint
  // in texture coordinates (0 interpolates the finest level). Images without alpha have alpha 1;
  // one-channel images are gray. Values that are not finite are 0. Returns black if the file fails
  // to decode or the coordinates are not finite.
  [[nodiscard]] Vec4 sample(TextureId id, Vec2 uv, TextureUse use = TextureUse::color,
                            Vec2 footprint = Vec2{0}) const noexcept;

  // Return the value times the texture, if there is one.
  [[nodiscard]] Vec3 color(const ColorInput& input, Vec2 uv, float footprint = 0) const noexcept;
  [[nodiscard]] float scalar(const ScalarInput& input, Vec2 uv, float footprint = 0) const noexcept;

  // Returns the whole image, without scale and offset. Throws TextureError if it cannot be decoded
  // or is not an image.
  [[nodiscard]] Image image(TextureId id) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
