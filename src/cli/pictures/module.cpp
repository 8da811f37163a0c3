// The module's side: a table of the libraries' functions.
#include "cli/pictures/functions.hpp"

extern "C" const pah::cli::PictureFunctions pahrender_picture_functions{
    &pah::write_image,        &pah::read_image,       &pah::read_metadata,
    &pah::read_image_header,  &pah::check_image_file, &pah::read_first_channel,
    &pah::make_texture_images};
