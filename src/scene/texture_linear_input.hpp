// An image reader that decodes sRGB before anything is filtered: a mip level averages light, not
// code values.
#pragma once

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>

namespace pah {

// Decodes the color channels of a row of texels in place; alpha is linear in the file.
void decode_srgb(float* texels, std::size_t count, int channels, int alpha_channel);

// Makes the cache serve `file` under `name`, decoded. False if the name is taken.
bool add_linear_image(OIIO::ImageCache& cache, const OIIO::ustring& name,
                      const std::filesystem::path& file);

}  // namespace pah
