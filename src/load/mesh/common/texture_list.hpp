// The textures of a mesh file, without duplicates.
#pragma once

#include <map>
#include <pah/load/mesh_file.hpp>
#include <string>
#include <tuple>

namespace pah {

class TextureList {
 public:
  explicit TextureList(std::vector<Texture>& textures) : textures_(textures) {}

  // Returns the id of the texture; adds it if it is new.
  TextureId add(const ImageTexture& image) {
    const Key key{image.file.string(), image.color_space, image.scale.x, image.scale.y,
                  image.offset.x,      image.offset.y,    image.clamp};
    const auto [found, is_new] = ids_.emplace(key, static_cast<TextureId>(textures_.size()));
    if (is_new) textures_.emplace_back(image);
    return found->second;
  }

 private:
  using Key = std::tuple<std::string, ColorSpace, double, double, double, double, bool>;

  std::vector<Texture>& textures_;
  std::map<Key, TextureId> ids_;
};

}  // namespace pah
