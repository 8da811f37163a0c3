#include "image/texture/images.hpp"

#include <OpenImageIO/texture.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "image/picture/open_picture.hpp"
#include "image/texture/input.hpp"

namespace pah {
namespace {

using Handle = OIIO::TextureSystem::TextureHandle;

struct ImageEntry {
  Handle* color = nullptr;  // decoded
  Handle* data = nullptr;   // as stored
  int channels = 0;
  bool srgb = false;
  bool clamp = false;
};

bool is_srgb(const ImageTexture& texture, const OIIO::ImageSpec& spec) {
  switch (texture.color_space) {
    case ColorSpace::srgb:
      return true;
    case ColorSpace::linear:
      return false;
    case ColorSpace::automatic:
      break;
  }
  const bool integer = spec.format == OIIO::TypeUInt8 || spec.format == OIIO::TypeUInt16;
  return integer && spec.nchannels >= 3;
}

OpenPicture open_image(const ImageTexture& texture, const TextureOptions& options) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return open_picture(texture.file, options.max_image_bytes, config, texture.bytes.get());
}

Vec4 as_rgba(const float* texel, int channels) {
  switch (channels) {
    case 1:
      return {texel[0], texel[0], texel[0], 1};
    case 2:
      return {texel[0], texel[0], texel[0], texel[1]};
    case 3:
      return {texel[0], texel[1], texel[2], 1};
    default:
      return {texel[0], texel[1], texel[2], texel[3]};
  }
}

// Lends each texture system to one store at a time, and never destroys it. OpenImageIO 2 keeps
// tiles and files of each thread by the address of the system. A later system at that address would
// use them as its own.
class SystemPool {
 public:
  static SystemPool& instance() {
    static auto* const pool = new SystemPool;  // may be needed until the last thread ends
    return *pool;
  }

  OIIO::TextureSystem* take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return OIIO::TextureSystem::create(false);
    OIIO::TextureSystem* const system = idle_.back();
    idle_.pop_back();
    return system;
  }

  // Frees the tiles; files are opened again at their next use.
  void give_back(OIIO::TextureSystem* system) {
    system->invalidate_all(true);
    const std::lock_guard lock(mutex_);
    idle_.push_back(system);
  }

 private:
  std::mutex mutex_;
  std::vector<OIIO::TextureSystem*> idle_;
};

// Images through OpenImageIO's TextureSystem.
class CachedImages final : public TextureImages {
 public:
  CachedImages(std::size_t count, const TextureOptions& options)
      : options_(options), entries_(count), system_(SystemPool::instance().take()) {
    system_->attribute("max_memory_MB", static_cast<float>(options.cache_megabytes));
    system_->attribute("autotile", 64);
    system_->attribute("automip", 1);
    system_->attribute("unassociatedalpha", 1);
    system_->attribute("max_errors_per_file", 1);
  }

  void load(TextureId id, const ImageTexture& texture) override;
  [[nodiscard]] Vec4 sample(TextureId id, bool decoded, const glm::dvec2& st,
                            const glm::dvec2& width) const override;
  [[nodiscard]] Image read_whole(TextureId id, const ImageTexture& texture) const override;

 private:
  struct GiveBack {
    void operator()(OIIO::TextureSystem* used) const { SystemPool::instance().give_back(used); }
  };

  TextureOptions options_;
  std::vector<ImageEntry> entries_;
  std::unique_ptr<OIIO::TextureSystem, GiveBack> system_;
};

void CachedImages::load(TextureId id, const ImageTexture& texture) {
  const OpenPicture opened = open_image(texture, options_);
  check_complete(opened);
  ImageEntry& entry = entries_[id];
  entry.channels = std::min(opened.spec.nchannels, 4);
  entry.srgb = is_srgb(texture, opened.spec);
  entry.clamp = texture.clamp;
  // A system remembers pictures of earlier stores, so pictures inside files get unique names.
  static std::atomic<std::uint64_t> unnamed{0};
  const std::string id_of_bytes = texture.bytes ? std::to_string(++unnamed) + ":" : "";
  // The file's own name would make OpenImageIO choose a reader itself.
  const auto handle = [&](TexelDecoding decoding) {
    const bool decode = decoding == TexelDecoding::srgb;
    const OIIO::ustring name((decode ? "colors:" : "data:") + std::to_string(id) + ":" +
                             id_of_bytes + texture.file.string());
    add_picture(*system_->imagecache(), name, texture, decoding);
    return system_->get_texture_handle(name);
  };
  entry.data = handle(TexelDecoding::none);
  entry.color = entry.srgb ? handle(TexelDecoding::srgb) : entry.data;
}

Vec4 CachedImages::sample(TextureId id, bool decoded, const glm::dvec2& st,
                          const glm::dvec2& width) const {
  const ImageEntry& image = entries_[id];
  static constexpr std::array<float, 4> black{0, 0, 0, 0};
  OIIO::TextureOpt opt;
  opt.swrap = image.clamp ? OIIO::TextureOpt::WrapClamp : OIIO::TextureOpt::WrapPeriodic;
  opt.twrap = opt.swrap;
  opt.interpmode = OIIO::TextureOpt::InterpBilinear;
  opt.missingcolor = black.data();
  const bool filtered = width.x > 0 || width.y > 0;
  opt.mipmode = filtered ? OIIO::TextureOpt::MipModeAniso : OIIO::TextureOpt::MipModeNoMIP;
  // OpenImageIO measures t from the top.
  const glm::dvec2 p{st.x, 1 - st.y};
  const glm::dvec2 q = image.clamp ? glm::clamp(p, 0.0, 1.0) : p - glm::floor(p);
  std::array<float, 4> texel{};
  system_->texture(decoded ? image.color : image.data, nullptr, opt, static_cast<float>(q.x),
                   static_cast<float>(q.y), static_cast<float>(std::min(width.x, 1.0)), 0, 0,
                   static_cast<float>(std::min(width.y, 1.0)), image.channels, texel.data());
  return as_rgba(texel.data(), image.channels);
}

Image CachedImages::read_whole(TextureId id, const ImageTexture& texture) const {
  const OpenPicture opened = open_image(texture, options_);
  const OIIO::ImageSpec& spec = opened.spec;
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  Image image{spec.width, spec.height, {}};
  image.pixels.reserve(spec.image_pixels());
  read_rows(opened, [&](std::span<float> values) {
    clear_unusable(values);
    if (entries_[id].srgb)
      decode_srgb(values.data(), values.size() / channels, spec.nchannels, spec.alpha_channel);
    for (std::size_t i = 0; i < values.size(); i += channels)
      image.pixels.emplace_back(as_rgba(&values[i], std::min(spec.nchannels, 4)));
  });
  return image;
}

}  // namespace

std::unique_ptr<TextureImages> make_texture_images(std::size_t count,
                                                   const TextureOptions& options) {
  return std::make_unique<CachedImages>(count, options);
}

}  // namespace pah
