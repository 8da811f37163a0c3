#include "image/texture/store.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel_for.hpp"
#include "image/texture/images.hpp"

namespace pah {
namespace {

struct Entry {
  bool checker = false;
  glm::dvec2 scale{1};
  glm::dvec2 offset{0};
  Vec4 a{0}, b{0};  // colors of the checkerboard
};

std::string described(const std::filesystem::path& file, const std::string& reason) {
  return "cannot read texture '" + file.string() + "': " + reason;
}

// Returns the mean over [x - w/2, x + w/2] of the square wave that is 1 on [0, 1), -1 on [1, 2),
// ...
double mean_square_wave(double x, double w) {
  const double low = x - w / 2;
  const double high = x + w / 2;
  if (!(low < high)) return std::fmod(std::abs(std::floor(x)), 2.0) == 0 ? 1 : -1;
  const auto integral = [](double t) { return 1 - std::abs(t - 2 * std::floor(t / 2) - 1); };
  return std::clamp((integral(high) - integral(low)) / (high - low), -1.0, 1.0);
}

Vec4 sample_checker(const Entry& entry, const glm::dvec2& st, const glm::dvec2& width) {
  const double same = mean_square_wave(st.x, width.x) * mean_square_wave(st.y, width.y);
  return glm::mix(entry.b, entry.a, static_cast<float>(0.5 + 0.5 * same));
}

}  // namespace

struct TextureStore::Impl {
  std::vector<Texture> textures;
  std::vector<Entry> entries;
  std::unique_ptr<TextureImages> images;  // null if no texture is an image
};

TextureStore::TextureStore(std::span<const Texture> textures, const TextureOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->textures.assign(textures.begin(), textures.end());
  impl_->entries.resize(textures.size());
  const auto is_image = [](const Texture& t) { return std::holds_alternative<ImageTexture>(t); };
  if (std::any_of(textures.begin(), textures.end(), is_image))
    impl_->images = make_texture_images(textures.size(), options);

  std::vector<std::optional<TextureError>> errors(textures.size());
  parallel_for(textures.size(), 1, [&](std::size_t i) {
    Entry& entry = impl_->entries[i];
    if (const auto* checker = std::get_if<CheckerTexture>(&textures[i])) {
      entry = {true, checker->scale, DVec2{0}, Vec4{checker->a, 1}, Vec4{checker->b, 1}};
      return;
    }
    const auto& image = std::get<ImageTexture>(textures[i]);
    entry.scale = image.scale;
    entry.offset = image.offset;
    try {
      impl_->images->load(static_cast<TextureId>(i), image);
    } catch (const std::exception& error) {
      errors[i].emplace(static_cast<TextureId>(i), described(image.file, error.what()));
    }
  });
  for (const auto& error : errors) {
    if (error) throw TextureError(*error);
  }
}

TextureStore::~TextureStore() = default;
TextureStore::TextureStore(TextureStore&&) noexcept = default;
TextureStore& TextureStore::operator=(TextureStore&&) noexcept = default;

Vec4 TextureStore::sample(TextureId id, Vec2 uv, TextureUse use, Vec2 footprint) const noexcept {
  const Entry& entry = impl_->entries[id];
  const glm::dvec2 st = glm::dvec2{uv} * entry.scale + entry.offset;
  if (!std::isfinite(st.x) || !std::isfinite(st.y)) return Vec4{0};
  const glm::dvec2 width = glm::abs(glm::dvec2{footprint} * entry.scale);
  if (entry.checker) return sample_checker(entry, st, width);
  // Without a declared encoding, the use decides whether the file holds colors or data.
  const bool declared =
      std::get_if<ImageTexture>(&impl_->textures[id])->color_space != ColorSpace::automatic;
  return impl_->images->sample(id, declared || use == TextureUse::color, st, width);
}

Vec3 TextureStore::color(const ColorInput& input, Vec2 uv, float footprint) const noexcept {
  if (input.texture == no_texture) return input.value;
  return input.value * Vec3{sample(input.texture, uv, TextureUse::color, Vec2{footprint})};
}

float TextureStore::scalar(const ScalarInput& input, Vec2 uv, float footprint) const noexcept {
  if (input.texture == no_texture) return input.value;
  return input.value * sample(input.texture, uv, TextureUse::data,
                              Vec2{footprint})[std::clamp(input.channel, 0, 3)];
}

Image TextureStore::image(TextureId id) const {
  const auto* texture = std::get_if<ImageTexture>(&impl_->textures[id]);
  if (!texture) throw TextureError(id, "a checkerboard is not an image");
  try {
    return impl_->images->read_whole(id, *texture);
  } catch (const std::exception& error) {
    throw TextureError(id, described(texture->file, error.what()));
  }
}

}  // namespace pah
