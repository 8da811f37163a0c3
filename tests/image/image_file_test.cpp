#include "catch.hpp"

#include <OpenImageIO/imageio.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <pah/geometry/vec.hpp>
#include <pah/image/compare.hpp>
#include <pah/image/image_file.hpp>

#include "image/srgb.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;

namespace {

Image ramp(int width, int height, float scale = 1) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels.push_back(scale * Vec3(static_cast<float>(x) / static_cast<float>(width - 1),
                                          static_cast<float>(y) / static_cast<float>(height - 1),
                                          0.25F));
  return image;
}

std::vector<ImageLayer> picture(const Image& image) { return {{"", {"R", "G", "B"}, image}}; }

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& e) {
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

double largest_difference(const Image& a, const Image& b) { return compare_images(a, b).max; }

}  // namespace

TEST_CASE("Pictures survive a round trip in every format") {
  const TemporaryFolder folder;
  const Image image = ramp(18, 10);
  for (const std::string& extension : image_extensions()) {
    CAPTURE(extension);
    const auto file = folder / ("picture" + extension);
    check_writable(file);
    CHECK_FALSE(std::filesystem::exists(file));
    write_image(file, picture(image));
    const Image back = read_image(file);
    REQUIRE(back.width == 18);
    REQUIRE(back.height == 10);
    // Half a step of 8-bit sRGB is 0.0045 where it is steepest; JPEG adds its own loss.
    const double bound = extension == ".exr"               ? 0.0005
                         : extension.rfind(".tif", 0) == 0 ? 1e-30
                         : extension == ".png"             ? 0.0046
                         : extension == ".hdr"             ? 0.0079
                                                           : 0.05;
    CHECK(largest_difference(back, image) < bound);
    // Only the picture is left in the folder.
    std::filesystem::remove(file);
    CHECK(std::filesystem::is_empty(folder.path()));
  }
}

TEST_CASE("Low dynamic range is exposed, clamped and rounded to sRGB") {
  const TemporaryFolder folder;
  Image image{5, 1, {Vec3(0.25F), Vec3(10), Vec3(-1), Vec3(NAN), Vec3(INFINITY)}};
  WriteOptions options;
  options.exposure = 1;
  write_image(folder / "a.png", picture(image), options);
  const auto in = OIIO::ImageInput::open((folder / "a.png").string());
  REQUIRE(in);
  REQUIRE(in->spec().format == OIIO::TypeUInt8);
  REQUIRE(in->spec().nchannels == 3);
  std::vector<unsigned char> bytes(15);
  REQUIRE(in->read_image(0, 0, 0, 3, OIIO::TypeUInt8, bytes.data()));
  CHECK(bytes[0] == std::lround(255 * srgb_from_linear(0.5F)));
  CHECK(bytes[3] == 255);
  CHECK(bytes[6] == 0);
  CHECK(bytes[9] == 0);
  CHECK(bytes[12] == 255);
}

TEST_CASE("PNG has 16 bits on request") {
  const TemporaryFolder folder;
  WriteOptions options;
  options.png_bits = 16;
  options.exposure = 1;
  write_image(folder / "a.png", picture(Image{1, 1, {Vec3(0.1F)}}), options);
  const auto in = OIIO::ImageInput::open((folder / "a.png").string());
  REQUIRE(in->spec().format == OIIO::TypeUInt16);
  CHECK(read_image(folder / "a.png").pixels[0].x == Approx(0.2).margin(2e-5));
  options.png_bits = 12;
  CHECK_THROWS_AS(write_image(folder / "a.png", picture(ramp(2, 2)), options),
                  std::invalid_argument);
}

TEST_CASE("High dynamic range is kept") {
  const TemporaryFolder folder;
  const Image image = ramp(4, 4, 1e4F);
  WriteOptions options;
  options.exposure = 3;  // ignored by these formats
  write_image(folder / "a.hdr", picture(image), options);
  CHECK(largest_difference(read_image(folder / "a.hdr"), image) < 1e4 / 256);
  write_image(folder / "a.exr", picture(image), options);
  CHECK(largest_difference(read_image(folder / "a.exr"), image) <= 4);
  for (const char* name : {"a.tif", "a.tiff"}) {
    write_image(folder / name, picture(image), options);
    CHECK(largest_difference(read_image(folder / name), image) == 0);
    CHECK(OIIO::ImageInput::open((folder / name).string())->spec().format == OIIO::TypeFloat);
  }
  options.full_float = true;
  write_image(folder / "b.exr", picture(image), options);
  CHECK(largest_difference(read_image(folder / "b.exr"), image) == 0);
  // Large values become the largest half, not infinity.
  write_image(folder / "c.exr", picture(Image{1, 1, {Vec3(1e6F, -1e6F, 1)}}));
  CHECK(read_image(folder / "c.exr").pixels[0] == Vec3(65504, -65504, 1));
}

TEST_CASE("EXR holds layers and metadata") {
  const TemporaryFolder folder;
  const Image depth{2, 1, {Vec3(1000.0625F), Vec3(3)}};
  const Image other{2, 1, {Vec3(0.5F), Vec3(0.125F)}};
  const Image image{2, 1, {Vec3(1, 2, 3), Vec3(4, 5, 6)}};
  WriteOptions options;
  options.metadata = {{"pahrender/scene", "a.yaml"}, {"pahrender/samples", "16"}};
  write_image(folder / "a.exr",
              {{"", {"R", "G", "B"}, image},
               {"albedo", {"R", "G", "B"}, other},
               {"normal", {"X", "Y", "Z"}, other},
               {"depth", {"Z"}, depth}},
              options);
  const auto in = OIIO::ImageInput::open((folder / "a.exr").string());
  REQUIRE(in);
  const OIIO::ImageSpec spec = in->spec();
  CHECK(spec.nchannels == 10);
  CHECK(spec.get_string_attribute("pahrender/scene") == "a.yaml");
  CHECK(spec.get_string_attribute("pahrender/samples") == "16");
  const int z = spec.channelindex("depth.Z");
  REQUIRE(z >= 0);
  CHECK(spec.channelformat(z) == OIIO::TypeFloat);
  CHECK(spec.channelformat(spec.channelindex("R")) == OIIO::TypeHalf);
  float values[2] = {};
  REQUIRE(in->read_image(0, 0, z, z + 1, OIIO::TypeFloat, values));
  CHECK(values[0] == 1000.0625F);
  const int y = spec.channelindex("normal.Y");
  REQUIRE(y >= 0);
  REQUIRE(in->read_image(0, 0, y, y + 1, OIIO::TypeFloat, values));
  CHECK(values[1] == 0.125F);
  CHECK(read_image(folder / "a.exr").pixels == image.pixels);
  // Formats without layers hold only the picture.
  write_image(folder / "a.png", {{"", {"R", "G", "B"}, image}, {"depth", {"Z"}, depth}}, options);
  CHECK(OIIO::ImageInput::open((folder / "a.png").string())->spec().nchannels == 3);
}

TEST_CASE("Equal pictures are equal files") {
  const TemporaryFolder folder;
  for (const std::string& extension : image_extensions()) {
    CAPTURE(extension);
    const auto file = folder / ("picture" + extension);
    write_image(file, picture(ramp(18, 10)));
    const auto in = OIIO::ImageInput::open(file.string());
    REQUIRE(in);
    CHECK(in->spec().get_string_attribute("DateTime").empty());
    CHECK(in->spec().get_string_attribute("ImageDescription").empty());
  }
}

TEST_CASE("Outputs that cannot be written are reported before rendering") {
  const TemporaryFolder folder;
  const auto check = [](const std::filesystem::path& file) {
    return message_of([&] { check_writable(file); });
  };
  CHECK(has(check(folder / "a.bmp"), "unknown picture format '.bmp'; available are .png, .jpg"));
  CHECK(has(check(folder / "a"), "no extension"));
  CHECK(has(check(folder / "none" / "a.png"), "none"));
  std::filesystem::create_directory(folder / "b.png");
  CHECK(has(check(folder / "b.png"), "b.png"));
  CHECK(check(folder / "A.PNG").empty());
  CHECK(has(message_of([&] { write_image(folder / "none" / "a.png", picture(ramp(2, 2))); }),
            "none/a.png"));
}

TEST_CASE("A full disk is noticed and the old picture kept") {
  const TemporaryFolder folder;
  const Image small = ramp(2, 2);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const std::string& extension : image_extensions()) {
    CAPTURE(extension);
    const auto file = folder / ("picture" + extension);
    write_image(file, picture(small));
    rlimit limit = before;
    limit.rlim_cur = 64;
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = message_of([&] { write_image(file, picture(ramp(300, 200))); });
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(has(message, "picture" + extension));
    CHECK(read_image(file).width == 2);
  }
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) ==
        static_cast<std::ptrdiff_t>(image_extensions().size()));
}

TEST_CASE("Files that cannot be read are reported") {
  const TemporaryFolder folder;
  const auto read = [](const std::filesystem::path& file, std::uint64_t limit = 1 << 20) {
    return message_of([&] { (void)read_image(file, limit); });
  };
  CHECK(has(read(folder / "none.png"), "it does not exist"));
  CHECK(has(read(folder.path()), "not a file"));
  std::ofstream(folder / "text.png") << "no picture at all";
  CHECK(has(read(folder / "text.png"), "text.png"));
  std::ofstream(folder / "empty.exr").flush();
  CHECK(has(read(folder / "empty.exr"), "empty.exr"));

  for (const std::string& extension : image_extensions()) {
    CAPTURE(extension);
    const auto file = folder / ("picture" + extension);
    write_image(file, picture(ramp(64, 64)));
    CHECK(read(file).empty());
    CHECK(has(read(file, 64 * 64), "64 x 64 pixels"));
    // A truncated file is an error, or a partial picture from lenient decoders, but never a crash.
    const auto size = std::filesystem::file_size(file);
    for (const auto part : {size / 8, size / 2, size - 1}) {
      std::filesystem::resize_file(file, part);
      (void)read(file);
    }
  }
}

TEST_CASE("A header with absurd sizes allocates nothing") {
  const TemporaryFolder folder;
  std::ofstream(folder / "huge.hdr", std::ios::binary)
      << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n";
  CHECK(has(message_of([&] { (void)read_image(folder / "huge.hdr"); }), "huge.hdr"));
}

TEST_CASE("Gray pictures are read as linear heights") {
  const TemporaryFolder folder;
  const auto out = OIIO::ImageOutput::create("gray.png");
  REQUIRE(out->open((folder / "gray.png").string(), OIIO::ImageSpec(2, 1, 1, OIIO::TypeUInt16)));
  const std::uint16_t values[2] = {0, 32768};
  REQUIRE(out->write_image(OIIO::TypeUInt16, values));
  REQUIRE(out->close());
  const Image image = read_image(folder / "gray.png");
  CHECK(image.pixels[0] == Vec3(0));
  CHECK(image.pixels[1].z == Approx(32768.0 / 65535));
}
