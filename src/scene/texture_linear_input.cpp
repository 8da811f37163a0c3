#include "scene/texture_linear_input.hpp"

#include <memory>
#include <string>
#include <vector>

#include "image/srgb.hpp"

namespace pah {

void decode_srgb(float* texels, std::size_t count, int channels, int alpha_channel) {
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < channels; ++c, ++texels) {
      if (c != alpha_channel) *texels = linear_from_srgb(*texels);
    }
  }
}

namespace {

constexpr const char* file_attribute = "pah:file";

// Reads through the file's own reader and hands on what that says of tiles, levels and sizes.
// 8-bit colors become half, which keeps them apart; wider ones float.
class LinearImageInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "pah_linear"; }

  bool open(const std::string& /*name*/, OIIO::ImageSpec& /*spec*/) override { return false; }

  bool open(const std::string& /*name*/, OIIO::ImageSpec& spec,
            const OIIO::ImageSpec& config) override {
    file_ = OIIO::ImageInput::open(config.get_string_attribute(file_attribute).c_str(), &config);
    if (!file_) {
      errorfmt("{}", OIIO::geterror());
      return false;
    }
    adopt_spec();
    spec = m_spec;
    return true;
  }

  bool close() override { return !file_ || file_->close(); }
  int current_subimage() const override { return file_->current_subimage(); }
  int current_miplevel() const override { return file_->current_miplevel(); }

  bool seek_subimage(int subimage, int miplevel) override {
    if (!file_->seek_subimage(subimage, miplevel)) return false;
    adopt_spec();
    return true;
  }

  bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    texels_.resize(static_cast<std::size_t>(m_spec.width) *
                   static_cast<std::size_t>(m_spec.nchannels));
    return deliver(file_->read_scanline(y, z, OIIO::TypeFloat, texels_.data()), data);
  }

  bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    texels_.resize(m_spec.tile_pixels() * static_cast<std::size_t>(m_spec.nchannels));
    return deliver(file_->read_tile(x, y, z, OIIO::TypeFloat, texels_.data()), data);
  }

 private:
  void adopt_spec() {
    m_spec = file_->spec();
    m_spec.set_format(file_->spec().format.basetype == OIIO::TypeDesc::UINT8 ? OIIO::TypeHalf
                                                                             : OIIO::TypeFloat);
    m_spec.channelformats.clear();
  }

  bool deliver(bool read, void* data) {
    if (!read) {
      errorfmt("{}", file_->geterror());
      return false;
    }
    const auto channels = static_cast<std::size_t>(m_spec.nchannels);
    decode_srgb(texels_.data(), texels_.size() / channels, m_spec.nchannels, m_spec.alpha_channel);
    return OIIO::convert_types(OIIO::TypeFloat, texels_.data(), m_spec.format, data,
                               static_cast<int>(texels_.size()));
  }

  std::unique_ptr<OIIO::ImageInput> file_;
  std::vector<float> texels_;
};

}  // namespace

bool add_linear_image(OIIO::ImageCache& cache, const OIIO::ustring& name,
                      const std::filesystem::path& file) {
  OIIO::ImageSpec config;
  config.attribute(file_attribute, file.string());
  return cache.add_file(
      name, []() -> OIIO::ImageInput* { return new LinearImageInput; }, &config);
}

}  // namespace pah
