// Image textures, the part of a TextureStore that needs OpenImageIO.
#pragma once

#include <cstddef>
#include <memory>
#include <pah/image/image.hpp>
#include <pah/image/texture.hpp>

#include "image/texture/store.hpp"

namespace pah {

// Everything is thread-safe.
class TextureImages {
 public:
  TextureImages() = default;
  TextureImages(const TextureImages&) = delete;
  TextureImages& operator=(const TextureImages&) = delete;
  virtual ~TextureImages() = default;

  // Opens the image and checks its size, before anything else is asked of it. Throws what is wrong
  // with it, without naming the file.
  virtual void load(TextureId id, const ImageTexture& texture) = 0;

  // About st, t = 0 being the bottom row, with colors decoded or as stored.
  [[nodiscard]] virtual Vec4 sample(TextureId id, bool decoded, const glm::dvec2& st,
                                    const glm::dvec2& width) const = 0;

  // Throws as load() does.
  [[nodiscard]] virtual Image read_whole(TextureId id, const ImageTexture& texture) const = 0;
};

// Room for images with ids less than `count`.
[[nodiscard]] std::unique_ptr<TextureImages> make_texture_images(std::size_t count,
                                                                 const TextureOptions& options);

}  // namespace pah
