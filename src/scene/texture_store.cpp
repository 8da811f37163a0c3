#include "scene/texture_store.hpp"

#include <OpenImageIO/texture.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "parallel/parallel_for.hpp"
#include "scene/texture_file.hpp"
#include "scene/texture_input.hpp"

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

struct Entry {
  bool checker = false;
  glm::dvec2 scale{1};
  glm::dvec2 offset{0};
  Vec4 a{0}, b{0};  // of the checkerboard
  ImageEntry image;
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

std::string described(const std::filesystem::path& file, const std::string& reason) {
  return "cannot read texture '" + file.string() + "': " + reason;
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

// The mean over [x - w/2, x + w/2] of the square wave that is 1 on [0, 1), -1 on [1, 2), ...
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

// Texture systems are lent to one store at a time and never destroyed: threads outlive them, and
// OpenImageIO 2 keeps for each thread tiles and files by the address of the system, which the next
// system at that address would take for its own.
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

  // Frees its tiles; files are opened anew when they are next asked for.
  void give_back(OIIO::TextureSystem* system) {
    system->invalidate_all(true);
    const std::lock_guard lock(mutex_);
    idle_.push_back(system);
  }

 private:
  std::mutex mutex_;
  std::vector<OIIO::TextureSystem*> idle_;
};

}  // namespace

struct TextureStore::Impl {
  struct GiveBack {
    void operator()(OIIO::TextureSystem* used) const { SystemPool::instance().give_back(used); }
  };

  TextureOptions options;
  std::vector<Texture> textures;
  std::vector<Entry> entries;
  std::unique_ptr<OIIO::TextureSystem, GiveBack> system;  // none if there are no images

  void start_system();
  [[nodiscard]] ImageEntry load(TextureId id, const ImageTexture& texture);
  [[nodiscard]] Image read_whole(TextureId id, const ImageTexture& texture) const;
  [[nodiscard]] Vec4 sample_image(const ImageEntry& image, bool decoded, const glm::dvec2& st,
                                  const glm::dvec2& width) const;
};

void TextureStore::Impl::start_system() {
  system.reset(SystemPool::instance().take());
  system->attribute("max_memory_MB", static_cast<float>(options.cache_megabytes));
  system->attribute("autotile", 64);
  system->attribute("automip", 1);
  system->attribute("unassociatedalpha", 1);
  system->attribute("max_errors_per_file", 1);
}

ImageEntry TextureStore::Impl::load(TextureId id, const ImageTexture& texture) {
  const OpenPicture opened = open_image(texture, options);
  check_complete(opened);
  ImageEntry entry;
  entry.channels = std::min(opened.spec.nchannels, 4);
  entry.srgb = is_srgb(texture, opened.spec);
  entry.clamp = texture.clamp;
  // A system remembers pictures of the stores before: those that are no files never come back.
  static std::atomic<std::uint64_t> unnamed{0};
  const std::string id_of_bytes = texture.bytes ? std::to_string(++unnamed) + ":" : "";
  // Not by the file's name, by which OpenImageIO would choose a reader itself.
  const auto handle = [&](TexelDecoding decoding) {
    const bool decode = decoding == TexelDecoding::srgb;
    const OIIO::ustring name((decode ? "colors:" : "data:") + std::to_string(id) + ":" +
                             id_of_bytes + texture.file.string());
    add_picture(*system->imagecache(), name, texture, decoding);
    return system->get_texture_handle(name);
  };
  entry.data = handle(TexelDecoding::none);
  entry.color = entry.srgb ? handle(TexelDecoding::srgb) : entry.data;
  return entry;
}

Vec4 TextureStore::Impl::sample_image(const ImageEntry& image, bool decoded, const glm::dvec2& st,
                                      const glm::dvec2& width) const {
  static constexpr std::array<float, 4> black{0, 0, 0, 0};
  OIIO::TextureOpt opt;
  opt.swrap = image.clamp ? OIIO::TextureOpt::WrapClamp : OIIO::TextureOpt::WrapPeriodic;
  opt.twrap = opt.swrap;
  opt.interpmode = OIIO::TextureOpt::InterpBilinear;
  opt.missingcolor = black.data();
  const bool filtered = width.x > 0 || width.y > 0;
  opt.mipmode = filtered ? OIIO::TextureOpt::MipModeAniso : OIIO::TextureOpt::MipModeNoMIP;
  // OpenImageIO counts t from the top.
  const glm::dvec2 p{st.x, 1 - st.y};
  const glm::dvec2 q = image.clamp ? glm::clamp(p, 0.0, 1.0) : p - glm::floor(p);
  std::array<float, 4> texel{};
  system->texture(decoded ? image.color : image.data, nullptr, opt, static_cast<float>(q.x),
                  static_cast<float>(q.y), static_cast<float>(std::min(width.x, 1.0)), 0, 0,
                  static_cast<float>(std::min(width.y, 1.0)), image.channels, texel.data());
  return as_rgba(texel.data(), image.channels);
}

Image TextureStore::Impl::read_whole(TextureId id, const ImageTexture& texture) const {
  const OpenPicture opened = open_image(texture, options);
  const OIIO::ImageSpec& spec = opened.spec;
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  Image image{spec.width, spec.height, {}};
  image.pixels.reserve(spec.image_pixels());
  read_rows(opened, [&](std::span<float> values) {
    clear_unusable(values);
    if (entries[id].image.srgb)
      decode_srgb(values.data(), values.size() / channels, spec.nchannels, spec.alpha_channel);
    for (std::size_t i = 0; i < values.size(); i += channels)
      image.pixels.emplace_back(as_rgba(&values[i], std::min(spec.nchannels, 4)));
  });
  return image;
}

TextureStore::TextureStore(std::span<const Texture> textures, const TextureOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  impl_->textures.assign(textures.begin(), textures.end());
  impl_->entries.resize(textures.size());
  const auto is_image = [](const Texture& t) { return std::holds_alternative<ImageTexture>(t); };
  if (std::any_of(textures.begin(), textures.end(), is_image)) impl_->start_system();

  std::vector<std::optional<TextureError>> errors(textures.size());
  parallel_for(textures.size(), 1, [&](std::size_t i) {
    Entry& entry = impl_->entries[i];
    if (const auto* checker = std::get_if<CheckerTexture>(&textures[i])) {
      entry = {true, checker->scale, DVec2{0}, Vec4{checker->a, 1}, Vec4{checker->b, 1}, {}};
      return;
    }
    const auto& image = std::get<ImageTexture>(textures[i]);
    entry.scale = image.scale;
    entry.offset = image.offset;
    try {
      entry.image = impl_->load(static_cast<TextureId>(i), image);
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
  // A file of no declared encoding holds colors or data: it depends on what it is used for.
  const bool declared =
      std::get_if<ImageTexture>(&impl_->textures[id])->color_space != ColorSpace::automatic;
  return impl_->sample_image(entry.image, declared || use == TextureUse::color, st, width);
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
  if (!texture) throw TextureError(id, "a checkerboard is no image");
  try {
    return impl_->read_whole(id, *texture);
  } catch (const std::exception& error) {
    throw TextureError(id, described(texture->file, error.what()));
  }
}

}  // namespace pah
