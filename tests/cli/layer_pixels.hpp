#pragma once

#include <string>
#include <vector>

namespace pah::test {

// Returns the values of all channels of an EXR file, including its layers.
[[nodiscard]] std::vector<float> layer_pixels(const std::string& file);

}  // namespace pah::test
