// Makes the texture cache read pictures with open_picture(), and decode sRGB on request before it
// filters: mip levels average light, not code values.
#pragma once

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <pah/image/texture.hpp>

namespace pah {

// Decodes the color channels of a row of texels in place; alpha is linear in the file.
void decode_srgb(float* texels, std::size_t count, int channels, int alpha_channel);

enum class TexelDecoding { none, srgb };

// Adds the picture to the cache under `name`; returns false if the name is taken. The picture's
// bytes, if any, must outlive the cache's use of it.
bool add_picture(OIIO::ImageCache& cache, const OIIO::ustring& name, const ImageTexture& picture,
                 TexelDecoding decoding);

}  // namespace pah
