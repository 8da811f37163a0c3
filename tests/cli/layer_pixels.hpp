#pragma once

#include <string>
#include <vector>

namespace pah::test {

// Of all channels of an EXR file, those of layers included.
[[nodiscard]] std::vector<float> layer_pixels(const std::string& file);

}  // namespace pah::test
