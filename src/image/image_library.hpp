// Loading of OpenImageIO, which reads and writes all pictures.
#pragma once

namespace pah {

// Prepares the functions that need OpenImageIO. This version does nothing, because they are linked.
// A program may define its own version and these functions, so that it starts without OpenImageIO
// (see cli/pictures). Throws FileError if no picture can be read or written.
void load_image_library();

}  // namespace pah
