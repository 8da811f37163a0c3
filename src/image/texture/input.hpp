// How the texture cache reads a picture: as open_picture() does, and decoding sRGB, where asked to,
// before anything is filtered: a mip level averages light, not code values.
#pragma once

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <pah/image/texture.hpp>

namespace pah {

// Decodes the color channels of a row of texels in place; alpha is linear in the file.
void decode_srgb(float* texels, std::size_t count, int channels, int alpha_channel);

enum class TexelDecoding { none, srgb };

// Makes the cache serve the picture under `name`. Its bytes, if it has any, have to live as long.
// False if the name is taken.
bool add_picture(OIIO::ImageCache& cache, const OIIO::ustring& name, const ImageTexture& picture,
                 TexelDecoding decoding);

}  // namespace pah
