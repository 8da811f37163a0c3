// Picture files with valid, damaged and hostile bytes.
#include "image/picture/open_picture.hpp"

#include <cmath>
#include <fstream>
#include <random>

#include "catch.hpp"
#include "image/picture/formats.hpp"
#include "image/srgb.hpp"
#include "image/texture/store.hpp"
#include "support/picture_bytes.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using namespace std::string_literals;

namespace {

// Returns the error of a file with these bytes, or "".
std::string fault_of(const std::string& bytes, const std::string& name = "a.png",
                     std::uint64_t max_bytes = most_picture_bytes) {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << bytes;
  try {
    check_complete(open_picture(folder / name, max_bytes));
    return "";
  } catch (const PictureError& error) {
    return error.what();
  }
}

// Returns a picture that OpenImageIO wrote with `attribute` set.
std::string written(const std::string& extension, const std::string& attribute = "",
                    const std::string& value = "") {
  const TemporaryFolder folder;
  const std::string file = (folder / ("a" + extension)).string();
  OIIO::ImageSpec spec(8, 6, 3, OIIO::TypeUInt8);
  if (!attribute.empty()) spec.attribute(attribute, value);
  const std::vector<unsigned char> texels(8 * 6 * 3, 77);
  const auto out = OIIO::ImageOutput::create(file);
  REQUIRE(out);
  REQUIRE(out->open(file, spec));
  REQUIRE(out->write_image(OIIO::TypeUInt8, texels.data()));
  REQUIRE(out->close());
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("The format of a picture does not depend on its name") {
  for (const char* extension : {".png", ".jpg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".webp"})
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.txt", "a"}) {
      CAPTURE(extension, name);
      CHECK(fault_of(written(extension), name).empty());
    }
}

TEST_CASE("Only the formats of the list are read") {
  CHECK(picture_format_names() == "PNG, JPEG, EXR, Radiance HDR, TIFF, BMP, WebP, TGA");
  for (const std::string& head :
       {"SDPX"s, "XPDS"s, "8BPS\0\1"s, "P6 1 1 255\nabc"s, "GIF89a"s, "DDS "s, "SIMPLE  ="s,
        "\x01\xDA\x01\x01"s, "\0\0\1\0\1\0"s, "\x59\xA6\x6A\x95"s, "FOR4"s, "no picture"s}) {
    const std::string fault = fault_of(head + std::string(4096, '\0'));
    CAPTURE(head);
    CHECK_THAT(fault, contains_text(picture_format_names()));
  }
  CHECK(fault_of("") == "it is empty");
}

TEST_CASE("Sizes are checked before anything is decoded") {
  CHECK_THAT(fault_of(test::png(60000, 60000, true, test::one_gray_pixel)),
             contains_text("60000 x 60000 pixels of 3 channels are more than 4096 MiB"));
  CHECK_THAT(fault_of(test::png(100, 100, false, test::one_gray_pixel), "a.png", 119999),
             contains_text("100 x 100 pixels of 1 channel"));
  CHECK_THAT(fault_of(test::tga(65535, 65535, "abc")), contains_text("65535 x 65535"));
  CHECK_THAT(fault_of("\xFF\xD8\xFF\xC2\x00\x11\x08\xFF\xFF\xFF\xFF\x03"s + std::string(9, '\0') +
                      "\xFF\xDA\x00\x02\xFF\xD9"s),
             contains_text("65535 x 65535"));
  CHECK_THAT(fault_of("BM"s + std::string(12, '\0') + "\x28\0\0\0"s + "\xFF\xFF\xFF\x7F"s +
                      "\x01\0\0\x80"s + "\x01\0\x08\0\x01\0\0\0"s + std::string(20, '\0')),
             contains_text("2147483647 x 2147483647"));
  CHECK_THAT(fault_of("RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0"s + std::string(4, '\0') +
                      "\xFF\xFF\0\xFE\xFF\0"s),
             contains_text("65536 x 65535"));
}

TEST_CASE("Files that end early are refused") {
  for (const char* extension : {".png", ".jpg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".webp"}) {
    const std::string whole = written(extension);
    // Data after a TGA file's texels are not read.
    const std::size_t end = extension == ".tga"s ? 18 + 8 * 6 * 3 : whole.size();
    for (const std::size_t size : {end / 2, end * 3 / 4}) {
      CAPTURE(extension, size);
      CHECK(!fault_of(whole.substr(0, size)).empty());
    }
  }
}

TEST_CASE("Metadata is not read, so it cannot do harm") {
  const std::string damaged = "iCCP\0\0"s + std::string(200, '\xFF');
  CHECK(fault_of(test::png(1, 1, false, test::one_gray_pixel)).empty());
  CHECK(fault_of(test::png(1, 1, false, test::one_gray_pixel, test::png_chunk("iCCP", damaged)))
            .empty());
  const TemporaryFolder folder;
  for (const char* extension : {".png", ".jpg", ".tif"}) {
    const auto file = folder / ("a"s + extension);
    std::ofstream(file, std::ios::binary) << written(extension, "Exif:LensModel", "a lens");
    CAPTURE(extension);
    const OpenPicture picture = open_picture(file, most_picture_bytes);
    CHECK(picture.spec.width == 8);
    CHECK(picture.spec.get_string_attribute("Exif:LensModel").empty());
    std::vector<unsigned char> texels(8 * 6 * 3);
    REQUIRE(picture.input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, texels.data()));
    CHECK(std::abs(texels.back() - 77) <= 1);
  }
}

TEST_CASE("A TIFF file whose directories go in a circle is read") {
  std::string bytes = written(".tif");
  const auto at = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  const std::size_t directory = at(4) | at(5) << 8U | at(6) << 16U;
  const std::size_t link = directory + 2 + 12 * (at(directory) | at(directory + 1) << 8U);
  bytes.replace(link, 4, bytes.substr(4, 4));
  CHECK(fault_of(bytes).empty());
}

TEST_CASE("Damaged bytes of every format are refused or read") {
  std::mt19937 rng(3);
  for (const char* extension : {".png", ".jpg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".webp"}) {
    const std::string whole = written(extension, "Exif:LensModel", "a lens");
    for (int trial = 0; trial < 100; ++trial) {
      std::string bytes = whole;
      for (int k = 0; k < 1 + trial % 5; ++k)
        bytes[4 + rng() % (bytes.size() - 4)] = static_cast<char>(rng());
      (void)fault_of(bytes, "a.png", 1 << 20);
    }
  }
}

TEST_CASE("NaNs in a file become black") {
  const TemporaryFolder folder;
  const std::string file = (folder / "a.exr").string();
  const std::vector<float> values{NAN, INFINITY, -INFINITY, 2e30F, 0.5F};
  const auto out = OIIO::ImageOutput::create(file);
  REQUIRE(out->open(file, OIIO::ImageSpec(5, 1, 1, OIIO::TypeFloat)));
  REQUIRE(out->write_image(OIIO::TypeFloat, values.data()));
  REQUIRE(out->close());
  CHECK(count_unusable(open_picture(file, most_picture_bytes)) == 4);
  for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
    const std::vector<Texture> textures{ImageTexture{file, space}};
    const TextureStore store(textures);
    const Image image = store.image(0);
    for (int x = 0; x < 5; ++x) {
      const float half = space == ColorSpace::linear ? 0.5F : linear_from_srgb(0.5F);
      const float expected = x < 4 ? 0 : half;
      CAPTURE(x);
      CHECK(store.sample(0, {(static_cast<float>(x) + 0.5F) / 5, 0.5F}).g ==
            Approx(expected).margin(1e-6));
      CHECK(image.at(x, 0).g == Approx(expected).margin(1e-6));
    }
  }
}
