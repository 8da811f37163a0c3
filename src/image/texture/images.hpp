// Image textures: the part of a TextureStore that needs OpenImageIO.
#pragma once

#include <cstddef>
#include <memory>
#include <pah/image/image.hpp>
#include <pah/image/texture.hpp>

#include "image/texture/store.hpp"

namespace pah {

// All functions are thread-safe.
class TextureImages {
 public:
  TextureImages() = default;
  TextureImages(const TextureImages&) = delete;
  TextureImages& operator=(const TextureImages&) = delete;
  virtual ~TextureImages() = default;

  // Opens the image and checks its size. Must come before all other calls for the image. Throws
  // std::exception with a message that does not name the file.
  virtual void load(TextureId id, const ImageTexture& texture) = 0;

  // Samples around st, where t = 0 is the bottom row, with colors decoded or as stored.
  [[nodiscard]] virtual Vec4 sample(TextureId id, bool decoded, const glm::dvec2& st,
                                    const glm::dvec2& width) const = 0;

  // Returns the whole image. Throws like load().
  [[nodiscard]] virtual Image read_whole(TextureId id, const ImageTexture& texture) const = 0;
};

// Makes a store for images with ids less than `count`.
[[nodiscard]] std::unique_ptr<TextureImages> make_texture_images(std::size_t count,
                                                                 const TextureOptions& options);

}  // namespace pah
