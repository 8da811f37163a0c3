// The functions that need OpenImageIO. Debian's package brings 250 libraries, which take longer to
// load than many scenes take to render. So these functions are in a module that the program loads
// when it first needs a picture.
#pragma once

#include <pah/image/image_file.hpp>

#include "image/image_header.hpp"
#include "image/texture/images.hpp"

namespace pah::cli {

struct PictureFunctions {
  decltype(&pah::write_image) write_image;
  decltype(&pah::read_image) read_image;
  decltype(&pah::read_metadata) read_metadata;
  decltype(&pah::read_image_header) read_image_header;
  decltype(&pah::check_image_file) check_image_file;
  decltype(&pah::read_first_channel) read_first_channel;
  decltype(&pah::make_texture_images) make_texture_images;
};

// The symbol that the module exports.
inline constexpr const char* picture_functions_name = "pahrender_picture_functions";

}  // namespace pah::cli
