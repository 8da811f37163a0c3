#include "image/image_header.hpp"

#include <OpenImageIO/imageio.h>

#include <new>
#include <pah/base/errors.hpp>
#include <stdexcept>

#include "image/picture/open_picture.hpp"

namespace pah {
namespace {

template <class Read>
auto guarded(const Read& read) {
  try {
    return read();
  } catch (const PictureError& error) {
    throw FileError(error.what());
  } catch (const std::bad_alloc&) {
    throw FileError("there is not enough memory for it");
  } catch (const std::length_error&) {
    throw FileError("it needs more memory than any machine has");
  }
}

}  // namespace

ImageHeader read_image_header(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return guarded([&] {
    const OpenPicture picture = open_picture(file, max_bytes);
    return ImageHeader{picture.spec.width, picture.spec.height};
  });
}

std::uint64_t check_image_file(const std::filesystem::path& file, std::uint64_t max_bytes,
                               const std::string* bytes) {
  return guarded([&] { return count_unusable(open_picture(file, max_bytes, {}, bytes)); });
}

std::vector<float> read_first_channel(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return guarded([&] {
    const OpenPicture picture = open_picture(file, max_bytes);
    std::vector<float> values(picture.spec.image_pixels());
    if (!picture.input->read_image(0, 0, 0, 1, OIIO::TypeFloat, values.data()))
      throw PictureError(reason_of(*picture.input));
    return values;
  });
}

}  // namespace pah
