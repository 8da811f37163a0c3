#include "image/image_library.hpp"

namespace pah {

void load_image_library() {}

}  // namespace pah
