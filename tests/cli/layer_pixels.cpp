#include "layer_pixels.hpp"

#include <OpenImageIO/imageio.h>

#include <stdexcept>

namespace pah::test {

std::vector<float> layer_pixels(const std::string& file) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) throw std::runtime_error("cannot open " + file);
  const OIIO::ImageSpec spec = input->spec();
  std::vector<float> pixels(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
    throw std::runtime_error("cannot read " + file);
  return pixels;
}

}  // namespace pah::test
