#include "image/texture/input.hpp"

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "image/picture/open_picture.hpp"
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
constexpr const char* bytes_attribute = "pah:bytes";
constexpr const char* srgb_attribute = "pah:srgb";

// Reads through the file's own reader, and passes on its tiles, levels and sizes. Decoded 8-bit
// colors become half, which keeps them distinct; wider ones become float.
class PictureInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "pah_picture"; }

  bool open(const std::string& /*name*/, OIIO::ImageSpec& /*spec*/) override { return false; }

  bool open(const std::string& /*name*/, OIIO::ImageSpec& spec,
            const OIIO::ImageSpec& config) override {
    config_ = config;
    if (!open_again()) return false;
    srgb_ = config.get_int_attribute(srgb_attribute) != 0;
    adopt_spec();
    spec = m_spec;
    return true;
  }

  bool close() override { return picture_.input == nullptr || picture_.input->close(); }
  int current_subimage() const override { return 0; }
  int current_miplevel() const override {
    return picture_.input == nullptr ? 0 : picture_.input->current_miplevel();
  }

  // Only the first picture of a file is used. Each of its levels has its own size in the file.
  bool seek_subimage(int subimage, int miplevel) override {
    if (subimage != 0 || picture_.input == nullptr || !picture_.input->seek_subimage(0, miplevel))
      return false;
    adopt_spec();
    return decoded_bytes(m_spec) <= static_cast<double>(most_picture_bytes);
  }

  bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    if (picture_.forward_only && y < next_row_ && !open_again()) return false;
    next_row_ = y + 1;
    const std::size_t count = static_cast<std::size_t>(m_spec.width);
    return deliver(count, data, [&](const OIIO::TypeDesc& type, void* texels) {
      return picture_.input->read_scanline(y, z, type, texels);
    });
  }

  bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    return deliver(m_spec.tile_pixels(), data, [&](const OIIO::TypeDesc& type, void* texels) {
      return picture_.input->read_tile(x, y, z, type, texels);
    });
  }

 private:
  bool open_again() {
    try {
      const std::string* bytes = nullptr;
      config_.getattribute(bytes_attribute, OIIO::TypeDesc::PTR, static_cast<void*>(&bytes));
      picture_.input.reset();  // before its proxy, and before memory for the new one is allocated
      picture_.proxy.reset();
      picture_ = open_picture(config_.get_string_attribute(file_attribute).c_str(),
                              most_picture_bytes, config_, bytes);
      return true;
    } catch (const PictureError& error) {
      errorfmt("{}", error.what());
      return false;
    }
  }

  void adopt_spec() {
    const OIIO::ImageSpec& spec = picture_.input->spec();
    m_spec = spec;
    const bool one_format = spec.channelformats.empty();
    if (srgb_)
      m_spec.set_format(spec.format == OIIO::TypeUInt8 ? OIIO::TypeHalf : OIIO::TypeFloat);
    else
      m_spec.set_format(one_format ? spec.format : OIIO::TypeFloat);
    m_spec.channelformats.clear();
  }

  template <class Read>
  bool deliver(std::size_t count, void* data, const Read& read) {
    const std::size_t values = count * static_cast<std::size_t>(m_spec.nchannels);
    const bool as_stored = !srgb_ && !m_spec.format.is_floating_point();
    if (!as_stored) texels_.resize(values);
    if (!(as_stored ? read(m_spec.format, data) : read(OIIO::TypeFloat, texels_.data()))) {
      errorfmt("{}", reason_of(*picture_.input));
      return false;
    }
    if (as_stored) return true;
    clear_unusable(texels_);
    if (srgb_) decode_srgb(texels_.data(), count, m_spec.nchannels, m_spec.alpha_channel);
    return OIIO::convert_types(OIIO::TypeFloat, texels_.data(), m_spec.format, data,
                               static_cast<int>(values));
  }

  OIIO::ImageSpec config_;
  OpenPicture picture_;
  int next_row_ = 0;
  bool srgb_ = false;
  std::vector<float> texels_;
};

}  // namespace

bool add_picture(OIIO::ImageCache& cache, const OIIO::ustring& name, const ImageTexture& picture,
                 TexelDecoding decoding) {
  OIIO::ImageSpec config;
  config.attribute(file_attribute, picture.file.string());
  const std::string* const bytes = picture.bytes.get();
  config.attribute(bytes_attribute, OIIO::TypeDesc::PTR, static_cast<const void*>(&bytes));
  config.attribute(srgb_attribute, decoding == TexelDecoding::srgb ? 1 : 0);
  return cache.add_file(
      name, []() -> OIIO::ImageInput* { return new PictureInput; }, &config);
}

}  // namespace pah
