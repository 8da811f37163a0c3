#include "io/image_header.hpp"

#include <OpenImageIO/imageio.h>

#include <pah/io/errors.hpp>

namespace pah {
namespace {

std::unique_ptr<OIIO::ImageInput> open(const std::filesystem::path& file) {
  auto input = OIIO::ImageInput::open(file.string());
  if (input == nullptr) throw FileError(OIIO::geterror());
  return input;
}

}  // namespace

ImageHeader read_image_header(const std::filesystem::path& file) {
  const auto input = open(file);
  const OIIO::ImageSpec& spec = input->spec();
  return {spec.width,     spec.height,         spec.depth,
          spec.nchannels, spec.image_pixels(), spec.image_bytes()};
}

std::vector<float> read_first_channel(const std::filesystem::path& file) {
  const auto input = open(file);
  std::vector<float> values(input->spec().image_pixels());
  if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, values.data()))
    throw FileError(input->geterror());
  return values;
}

}  // namespace pah
