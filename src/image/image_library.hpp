// OpenImageIO, behind write_image() and all that reads pictures.
#pragma once

namespace pah {

// A program may define this, and the functions that need OpenImageIO, so that it starts without:
// see cli/pictures. As linked here, everything is ready, and this does nothing. Throws FileError if
// no picture can be read or written.
void load_image_library();

}  // namespace pah
