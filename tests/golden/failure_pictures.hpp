// Pictures that help to find out why a picture differs from its reference.
#pragma once

#include <filesystem>
#include <string>

#include "t_test.hpp"

namespace pah::golden {

// Writes to the build's folder golden_failures: <name>_image.exr; <name>_difference.exr, picture
// minus reference; <name>_p_value.png, white where nothing is doubtful, red where a pixel failed.
// Returns the folder.
std::filesystem::path write_failure(const std::string& name, const Batches& reference,
                                    const Batches& picture, const Comparison& comparison);

}  // namespace pah::golden
