#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pah/geometry/vec.hpp>
#include <pah/image/image_file.hpp>
#include <string_view>

#include "base/output_file.hpp"
#include "image/image_format.hpp"
#include "image/picture/open_picture.hpp"
#include "image/srgb.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_read(const fs::path& file, const std::string& reason) {
  throw FileError("cannot read " + file.string() + ": " + reason);
}

std::string or_unknown(std::string message) {
  if (message.empty()) return "unknown error";
  return message;
}

// Clamps to [low, high]; NaN becomes `low`.
float clamped(float x, float low, float high) { return x > low ? std::min(x, high) : low; }

template <class Integer>
std::vector<Integer> srgb_pixels(const Image& image, double exposure) {
  const auto factor = static_cast<float>(std::exp2(exposure));
  constexpr auto steps = static_cast<float>(std::numeric_limits<Integer>::max());
  std::vector<Integer> values;
  values.reserve(3 * image.pixels.size());
  for (const Vec3& pixel : image.pixels)
    for (int k = 0; k < 3; ++k) {
      const float x = srgb_from_linear(clamped(pixel[k] * factor, 0, 1));
      values.push_back(static_cast<Integer>(x * steps + 0.5F));
    }
  return values;
}

std::vector<float> rgbe_pixels(const Image& image) {
  std::vector<float> values;
  values.reserve(3 * image.pixels.size());
  for (const Vec3& pixel : image.pixels)
    for (int k = 0; k < 3; ++k) values.push_back(clamped(pixel[k], 0, 0x1p126F));
  return values;
}

// 16 bits suffice for colors and directions, but not for distances and variances.
bool fits_half(const ImageLayer& layer) {
  return layer.name.empty() || layer.name == "albedo" || layer.name == "normal";
}

// Returns all channels of all layers, pixel by pixel, and adds the channels to `spec`.
std::vector<float> exr_pixels(const std::vector<ImageLayer>& layers, bool full_float,
                              OIIO::ImageSpec& spec) {
  spec.channelnames.clear();
  std::size_t stride = 0;
  for (const ImageLayer& layer : layers) stride += layer.channels.size();
  std::vector<float> values(stride * layers.front().image.pixels.size());
  std::size_t first = 0;
  for (const ImageLayer& layer : layers) {
    const bool half = !full_float && fits_half(layer);
    for (const std::string& channel : layer.channels) {
      spec.channelnames.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
      spec.channelformats.push_back(half ? OIIO::TypeHalf : OIIO::TypeFloat);
    }
    for (std::size_t i = 0; i < layer.image.pixels.size(); ++i)
      for (std::size_t k = 0; k < layer.channels.size(); ++k) {
        const float x = layer.image.pixels[i][static_cast<int>(k)];
        // Larger values would become infinite.
        values[i * stride + first + k] = half && std::isfinite(x) ? clamped(x, -65504, 65504) : x;
      }
    first += layer.channels.size();
  }
  spec.nchannels = static_cast<int>(stride);
  return values;
}

void require_layers(const std::vector<ImageLayer>& layers) {
  if (layers.empty()) throw std::invalid_argument("a picture needs a layer");
  const Image& first = layers.front().image;
  for (const ImageLayer& layer : layers) {
    const Image& image = layer.image;
    const bool sized = image.width > 0 && image.height > 0 && image.width == first.width &&
                       image.height == first.height &&
                       image.pixels.size() == static_cast<std::size_t>(image.width) *
                                                  static_cast<std::size_t>(image.height);
    if (!sized) throw std::invalid_argument("layers of different or no size");
    if (layer.channels.empty() || layer.channels.size() > 3)
      throw std::invalid_argument("a layer has one to three channels");
  }
}

OIIO::ImageSpec spec_of(const Image& image, Encoding encoding, const WriteOptions& options) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeFloat);
  // A date would make the files of equal pictures differ.
  spec.attribute("DateTime", "");
  spec.attribute("Software", "pahrender");
  spec.attribute("Compression", encoding == Encoding::jpeg ? "jpeg:95" : "zip");
  spec.attribute("jpeg:subsampling", "4:4:4");
  if (encoding == Encoding::png || encoding == Encoding::jpeg)
    spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [name, value] : options.metadata) spec.attribute(name, value);
  return spec;
}

// Writes to the file `to`, or to the output's proxy if it has one. Errors name `file`.
void encode(const fs::path& file, const std::string& to, OIIO::ImageOutput& out, Encoding encoding,
            const std::vector<ImageLayer>& layers, const WriteOptions& options) {
  const Image& image = layers.front().image;
  OIIO::ImageSpec spec = spec_of(image, encoding, options);
  const auto write = [&](const OIIO::TypeDesc& type, const void* values) {
    if (!(out.open(to, spec) && out.write_image(type, values) && out.close()))
      fail_to_write(file, or_unknown(out.geterror()));
  };
  switch (encoding) {
    case Encoding::png:
      if (options.png_bits == 16) {
        spec.set_format(OIIO::TypeUInt16);
        return write(OIIO::TypeUInt16, srgb_pixels<std::uint16_t>(image, options.exposure).data());
      }
      [[fallthrough]];
    case Encoding::jpeg:
      spec.set_format(OIIO::TypeUInt8);
      return write(OIIO::TypeUInt8, srgb_pixels<std::uint8_t>(image, options.exposure).data());
    case Encoding::tiff:
      return write(OIIO::TypeFloat, image.pixels.data());
    case Encoding::rgbe:
      return write(OIIO::TypeFloat, rgbe_pixels(image).data());
    case Encoding::exr:
      const std::vector<float> values = exr_pixels(layers, options.full_float, spec);
      return write(OIIO::TypeFloat, values.data());
  }
}

// libtiff reads back what it has written, which OpenImageIO's memory proxy does not support.
void write_by_file(const fs::path& file, OIIO::ImageOutput& out, Encoding encoding,
                   const std::vector<ImageLayer>& layers, const WriteOptions& options) {
  const fs::path temporary = temporary_beside(file);
  try {
    encode(file, temporary.string(), out, encoding, layers, options);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  put_in_place(temporary, file);
}

// The first of three color channels, or a single channel to use as gray.
struct Channels {
  int first = 0;
  bool color = false;
};

Channels channels_of(const OIIO::ImageSpec& spec) {
  const auto& names = spec.channelnames;
  for (std::size_t i = 0; i + 2 < names.size(); ++i)
    if (names[i] == "R" && names[i + 1] == "G" && names[i + 2] == "B")
      return {static_cast<int>(i), true};
  return {0, spec.nchannels >= 3};
}

}  // namespace

void write_image(const fs::path& file, const std::vector<ImageLayer>& layers,
                 const WriteOptions& options) {
  const Encoding encoding = encoding_of(file);
  require_layers(layers);
  if (options.png_bits != 8 && options.png_bits != 16)
    throw std::invalid_argument("a PNG file has 8 or 16 bits");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);  // outlives the output, which may write at its end
  const auto out = OIIO::ImageOutput::create(file.filename().string());
  if (!out) fail_to_write(file, or_unknown(OIIO::geterror()));
  if (encoding == Encoding::tiff) return write_by_file(file, *out, encoding, layers, options);
  // Encodes in memory first, because not every encoder notices a full disk.
  out->set_ioproxy(&proxy);
  encode(file, file.filename().string(), *out, encoding, layers, options);
  write_text_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

ImageMetadata read_metadata(const fs::path& file) {
  // open_picture() would leave out the metadata.
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) fail_to_read(file, or_unknown(OIIO::geterror()));
  ImageMetadata metadata;
  for (const OIIO::ParamValue& value : input->spec().extra_attribs)
    if (value.type() == OIIO::TypeString)
      metadata.emplace_back(value.name().string(), value.get_string());
  return metadata;
}

Image read_image(const fs::path& file, std::uint64_t max_bytes) {
  try {
    const OpenPicture picture = open_picture(file, max_bytes);
    const OIIO::ImageSpec& spec = picture.spec;
    const auto [first, color] = channels_of(spec);
    const bool srgb = color && (spec.format == OIIO::TypeUInt8 || spec.format == OIIO::TypeUInt16);

    Image image{spec.width, spec.height, std::vector<Vec3>(spec.image_pixels())};
    const OIIO::stride_t stride = sizeof(Vec3);
    if (!picture.input->read_image(0, 0, first, first + (color ? 3 : 1), OIIO::TypeFloat,
                                   image.pixels.data(), stride))
      fail_to_read(file, reason_of(*picture.input));
    for (Vec3& pixel : image.pixels) {
      if (!color) pixel = Vec3(pixel.x);
      if (srgb)
        for (int k = 0; k < 3; ++k) pixel[k] = linear_from_srgb(pixel[k]);
    }
    return image;
  } catch (const PictureError& error) {
    fail_to_read(file, error.what());
  } catch (const std::bad_alloc&) {
    fail_to_read(file, "out of memory");
  }
}

}  // namespace pah
