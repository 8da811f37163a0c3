#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <random>

#include "base/parallel_for.hpp"
#include "catch.hpp"
#include "image/srgb.hpp"
#include "image/texture/input.hpp"
#include "image/texture/store.hpp"
#include "support/paths.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;
namespace fs = std::filesystem;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Images of a test, which are removed at its end.
class ImageFolder {
 public:
  ImageFolder()
      : path_(test::build_folder() / ("texture-test-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(path_);
  }
  ~ImageFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ImageFolder(const ImageFolder&) = delete;
  ImageFolder& operator=(const ImageFolder&) = delete;

  using Texel = std::function<float(int x, int y, int channel)>;  // y from the top
  fs::path write(const std::string& name, int width, int height, int channels,
                 OIIO::TypeDesc format, const Texel& texel, int tile = 0) const {
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) values.push_back(texel(x, y, c));
    OIIO::ImageSpec spec(width, height, channels, format);
    spec.tile_width = spec.tile_height = tile;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const fs::path file = path_ / name;
    auto out = OIIO::ImageOutput::create(file.string());
    REQUIRE(out);
    REQUIRE(out->open(file.string(), spec));
    REQUIRE(out->write_image(OIIO::TypeFloat, values.data()));
    REQUIRE(out->close());
    return file;
  }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

TextureStore store_of(ImageTexture texture, const TextureOptions& options = {}) {
  const std::vector<Texture> textures{std::move(texture)};
  return TextureStore(textures, options);
}

// Returns the message of the error that the texture causes.
std::string error_of(const ImageTexture& texture, const TextureOptions& options = {}) {
  std::string message = "none";
  try {
    const std::vector<Texture> textures{CheckerTexture{}, texture};
    const TextureStore store(textures, options);
  } catch (const TextureError& error) {
    CHECK(error.id() == 1);
    message = error.what();
  }
  return message;
}

Vec2 center_of(int x, int y, int width, int height) {
  return {(static_cast<float>(x) + 0.5F) / static_cast<float>(width),
          1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(height)};
}

}  // namespace

TEST_CASE("Texels of a linear image start at v = 0 at the bottom") {
  const ImageFolder folder;
  const auto texel = [](int x, int y, int c) { return 0.25F * static_cast<float>(x + 4 * y + c); };
  const TextureStore store = store_of({folder.write("a.exr", 4, 8, 3, OIIO::TypeFloat, texel)});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 4; ++x) {
      const Vec4 value = store.sample(0, center_of(x, y, 4, 8));
      CAPTURE(x, y);
      for (int c = 0; c < 3; ++c) CHECK(value[c] == Approx(texel(x, y, c)).margin(1e-5));
      CHECK(value.a == 1);
    }
  }
  // Half way between two texels of a row.
  CHECK(store.sample(0, {0.25F, 1 - 0.5F / 8}).x == Approx(0.125));
}

TEST_CASE("Integer color images are sRGB unless declared otherwise, or used as data") {
  const ImageFolder folder;
  const auto code = [](int x, int, int) { return static_cast<float>(x * 17) / 255.0F; };
  const auto check = [&](const fs::path& file, ColorSpace space, TextureUse use, bool decoded) {
    const TextureStore store = store_of({file, space});
    for (int x = 0; x < 16; ++x) {
      const float expected = decoded ? linear_from_srgb(code(x, 0, 0)) : code(x, 0, 0);
      CAPTURE(file, x);
      CHECK(store.sample(0, center_of(x, 0, 16, 1), use).g == Approx(expected).margin(3e-4));
    }
  };
  const fs::path rgb8 = folder.write("a.png", 16, 1, 3, OIIO::TypeUInt8, code);
  const fs::path rgb16 = folder.write("b.png", 16, 1, 3, OIIO::TypeUInt16, code);
  const fs::path gray = folder.write("c.png", 16, 1, 1, OIIO::TypeUInt8, code);
  const fs::path real = folder.write("d.tif", 16, 1, 3, OIIO::TypeFloat, code);
  const fs::path half = folder.write("e.exr", 16, 1, 3, OIIO::TypeHalf, code);
  for (const fs::path& file : {rgb8, rgb16}) {
    check(file, ColorSpace::automatic, TextureUse::color, true);
    check(file, ColorSpace::automatic, TextureUse::data, false);
    check(file, ColorSpace::srgb, TextureUse::data, true);
    check(file, ColorSpace::linear, TextureUse::color, false);
  }
  check(gray, ColorSpace::automatic, TextureUse::color, false);
  check(gray, ColorSpace::srgb, TextureUse::color, true);
  check(real, ColorSpace::automatic, TextureUse::color, false);
  check(half, ColorSpace::automatic, TextureUse::color, false);
  check(real, ColorSpace::srgb, TextureUse::color, true);
}

TEST_CASE("A footprint averages light, not code values") {
  const ImageFolder folder;
  const auto dots = [](int x, int y, int) { return static_cast<float>((x + y) % 2); };
  // Scanlines, tiles and stored levels take different paths through the decoder.
  const fs::path scanlines = folder.write("a.png", 256, 256, 3, OIIO::TypeUInt8, dots);
  const fs::path tiles = folder.write("b.tif", 256, 256, 3, OIIO::TypeUInt8, dots, 64);
  for (const fs::path& file : {scanlines, tiles}) {
    const TextureStore store = store_of({file, ColorSpace::automatic});
    CAPTURE(file);
    for (const float width : {0.1F, 0.5F, 1.0F, 10.0F}) {
      CHECK(store.sample(0, {0.37F, 0.61F}, TextureUse::color, Vec2{width}).r ==
            Approx(0.5).margin(0.01));
    }
    CHECK(store.sample(0, center_of(3, 5, 256, 256)).r == Approx(0).margin(1e-5));
    CHECK(store.sample(0, center_of(3, 6, 256, 256)).r == Approx(1).margin(1e-3));
  }
}

TEST_CASE("Stored levels of a texture file are decoded and used") {
  const ImageFolder folder;
  const auto gray = [](int, int, int) { return 0.5F; };
  const fs::path flat = folder.write("flat.png", 128, 128, 3, OIIO::TypeUInt8, gray);
  const fs::path file = folder / "flat.tx";
  OIIO::ImageSpec config;
  config.attribute("maketx:opaque_detect", 0);
  config.attribute("maketx:constant_color_detect", 0);
  REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, flat.string(),
                                           file.string(), config));
  const TextureStore store = store_of({file, ColorSpace::automatic});
  for (const float width : {0.0F, 0.05F, 0.4F, 1.0F}) {
    CHECK(store.sample(0, {0.4F, 0.3F}, TextureUse::color, Vec2{width}).r ==
          Approx(linear_from_srgb(128 / 255.0F)).epsilon(2e-3));
  }
}

TEST_CASE("Channels become colors, alpha apart") {
  const ImageFolder folder;
  const auto ramp = [](int, int, int c) { return 0.2F * static_cast<float>(c + 1); };
  const auto texel = [&](int channels) {
    const std::string name = std::to_string(channels) + ".tif";
    const fs::path file = folder.write(name, 4, 4, channels, OIIO::TypeFloat, ramp);
    return store_of({file}).sample(0, Vec2{0.5F});
  };
  CHECK(glm::distance(texel(1), Vec4{0.2F, 0.2F, 0.2F, 1}) < 1e-6F);
  CHECK(glm::distance(texel(2), Vec4{0.2F, 0.2F, 0.2F, 0.4F}) < 1e-6F);
  CHECK(glm::distance(texel(3), Vec4{0.2F, 0.4F, 0.6F, 1}) < 1e-6F);
  CHECK(glm::distance(texel(4), Vec4{0.2F, 0.4F, 0.6F, 0.8F}) < 1e-6F);
  CHECK(glm::distance(texel(6), Vec4{0.2F, 0.4F, 0.6F, 0.8F}) < 1e-6F);

  // Color under a transparent texel stays as stored, decoded or not; alpha is never decoded.
  const auto clear = [](int, int, int c) { return c == 3 ? 0.2F : 1.0F; };
  const fs::path file = folder.write("clear.png", 4, 4, 4, OIIO::TypeUInt8, clear);
  for (const TextureUse use : {TextureUse::color, TextureUse::data}) {
    const Vec4 value = store_of({file}).sample(0, Vec2{0.5F}, use);
    CHECK(value.r == Approx(1).margin(1e-3));
    CHECK(value.a == Approx(0.2).margin(1e-3));
  }
}

TEST_CASE("Coordinates are scaled, repeat or clamp, and may be anything") {
  const ImageFolder folder;
  const auto ramp = [](int x, int y, int) { return static_cast<float>(x + 10 * y); };
  const fs::path file = folder.write("a.tif", 8, 8, 3, OIIO::TypeFloat, ramp);
  const TextureStore repeat = store_of({file});
  const TextureStore clamp = store_of({file, ColorSpace::automatic, {1, 1}, {0, 0}, true});
  const TextureStore scaled = store_of({file, ColorSpace::automatic, {2, 0.5}, {0.25, -1}, false});
  const Vec2 p = center_of(2, 5, 8, 8);
  CHECK(repeat.sample(0, p + Vec2{3, -2}).r == Approx(52));
  CHECK(clamp.sample(0, {-3, p.y}).r == Approx(50));
  CHECK(clamp.sample(0, {1e30F, p.y}).r == Approx(57));
  CHECK(scaled.sample(0, (p - Vec2{0.25F, -1}) / Vec2{2, 0.5F}).r == Approx(52));
  // A repeated image blends both ends at the seam.
  CHECK(repeat.sample(0, {0, p.y}).r == Approx(53.5));
  for (const TextureStore* store : {&repeat, &clamp}) {
    for (const float u : {infinity, -infinity, std::nanf(""), 3e38F, -1e20F, 1e-45F}) {
      for (const float width : {0.0F, 1e-40F, 0.1F, 1e30F, infinity}) {
        const Vec4 value = store->sample(0, {u, 0.3F}, TextureUse::color, {width, 0});
        CHECK(value.r >= 0);
        CHECK(value.r <= 77);
        if (!std::isfinite(u)) CHECK(value == Vec4{0});
      }
    }
  }
}

TEST_CASE("Checkerboards are sharp or averaged") {
  CheckerTexture checker;
  checker.a = Vec3{1};
  checker.b = Vec3{0};
  checker.scale = {2, 4};
  const std::vector<Texture> textures{checker};
  const TextureStore store(textures);
  const auto at = [&](float u, float v, float width = 0) {
    return store.sample(0, {u, v}, TextureUse::color, Vec2{width}).r;
  };
  CHECK(at(0.1F, 0.1F) == 1);
  CHECK(at(0.6F, 0.1F) == 0);
  CHECK(at(0.1F, 0.3F) == 0);
  CHECK(at(-0.1F, 0.1F) == 0);
  CHECK(at(-0.1F, -0.1F) == 1);
  CHECK(at(0.25F, 0.125F, 0.01F) == Approx(1));
  // Half of a footprint on an edge has color a, and so has half of one over many squares.
  CHECK(at(0.5F, 0.125F, 0.01F) == Approx(0.5).margin(1e-6));
  CHECK(at(0.3F, 0.7F, 100) == Approx(0.5).margin(0.01));
  // The result equals the mean of point samples.
  double sum = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += static_cast<double>(at(0.4F + 0.3F * ((static_cast<float>(i) + 0.5F) / n - 0.5F),
                                    0.2F + 0.3F * ((static_cast<float>(j) + 0.5F) / n - 0.5F)));
  CHECK(at(0.4F, 0.2F, 0.3F) == Approx(sum / (n * n)).margin(0.005));
  for (const float u : {infinity, std::nanf(""), 1e38F}) CHECK(at(u, 0, 1e-30F) >= 0);
  CHECK_THROWS_AS(store.image(0), TextureError);
}

TEST_CASE("Inputs multiply their texture") {
  CheckerTexture checker;
  checker.a = {0.5F, 0.25F, 1};
  checker.b = checker.a;
  const std::vector<Texture> textures{checker};
  const TextureStore store(textures);
  CHECK(store.color({Vec3{2}, no_texture}, {}) == Vec3{2});
  CHECK(store.color({Vec3{2}, 0}, {}) == Vec3{1, 0.5F, 2});
  CHECK(store.scalar({3, no_texture, 2}, {}) == 3);
  CHECK(store.scalar({3, 0, 1}, {}) == 0.75F);
}

TEST_CASE("A whole image is returned for importance sampling") {
  const ImageFolder folder;
  const auto texel = [](int x, int y, int) { return static_cast<float>(x + 2 * y) / 255.0F; };
  const TextureStore store = store_of({folder.write("a.png", 2, 3, 3, OIIO::TypeUInt8, texel)});
  const Image image = store.image(0);
  REQUIRE(image.width == 2);
  REQUIRE(image.height == 3);
  for (int i = 0; i < 6; ++i) {
    CHECK(image.pixels[static_cast<std::size_t>(i)].b ==
          Approx(linear_from_srgb(static_cast<float>(i) / 255.0F)));
  }
}

TEST_CASE("Files that cannot be read are refused by name") {
  const ImageFolder folder;
  CHECK_THAT(error_of({folder / "missing.png"}), contains_text("missing.png"));
  std::ofstream(folder / "text.png") << "this is no picture";
  CHECK_THAT(error_of({folder / "text.png"}), contains_text("text.png"));
  std::ofstream(folder / "empty.exr").flush();
  CHECK_THAT(error_of({folder / "empty.exr"}), contains_text("empty.exr"));
  CHECK_THAT(error_of({folder / "text.unknown"}), contains_text("text.unknown"));

  const auto noise = [](int x, int y, int c) {
    return static_cast<float>((x * 7919 + y * 104729 + c * 31) % 256) / 255.0F;
  };
  for (const char* name : {"cut.png", "cut.tif", "cut.exr"}) {
    const fs::path file = folder.write(name, 200, 200, 3, OIIO::TypeUInt8, noise);
    CHECK(error_of({file}) == "none");
    fs::resize_file(file, fs::file_size(file) / 2);
    CHECK_THAT(error_of({file}), contains_text(name));
  }
}

TEST_CASE("An image beyond the limit is refused before it is decoded") {
  const ImageFolder folder;
  const auto gray = [](int, int, int) { return 0.5F; };
  const fs::path file = folder.write("a.png", 100, 100, 3, OIIO::TypeUInt8, gray);
  TextureOptions options;
  options.max_image_bytes = 100 * 100 * 3 * 4;
  CHECK(error_of({file}, options) == "none");
  --options.max_image_bytes;
  CHECK_THAT(error_of({file}, options), contains_text("100 x 100"));

  // A header that claims 65535 x 65535 over a few bytes of data.
  std::ofstream(folder / "huge.tga", std::ios::binary) << test::tga(65535, 65535, "abc");
  CHECK_THAT(error_of({folder / "huge.tga"}), contains_text("65535 x 65535"));
}

TEST_CASE("Damaged files are refused or black, never fatal") {
  const ImageFolder folder;
  const auto noise = [](int x, int y, int c) {
    return static_cast<float>((x * 7919 + y * 104729 + c * 31) % 256) / 255.0F;
  };
  std::mt19937 rng(1);
  TextureOptions options;
  options.max_image_bytes = 1 << 20;
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr", "a.tga", "a.bmp"}) {
    const OIIO::TypeDesc format =
        fs::path(name).extension() == ".hdr" ? OIIO::TypeFloat : OIIO::TypeUInt8;
    const fs::path file = folder.write(name, 24, 16, 3, format, noise);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    for (int trial = 0; trial < 60; ++trial) {
      std::string damaged = bytes;
      for (int k = 0; k < 1 + trial % 8; ++k) {
        // Damage in headers is the most dangerous.
        const std::size_t range =
            k % 2 == 0 ? std::min<std::size_t>(200, bytes.size()) : bytes.size();
        damaged[rng() % range] = static_cast<char>(rng());
      }
      if (trial % 5 == 0) damaged.resize(rng() % damaged.size());
      const fs::path target = folder / (std::to_string(trial) + name);
      std::ofstream(target, std::ios::binary) << damaged;
      try {
        const TextureStore store = store_of({target}, options);
        for (int i = 0; i < 8; ++i) {
          const float u = static_cast<float>(i) / 8.0F;
          (void)store.sample(0, {u, u}, TextureUse::color, Vec2{i % 2 == 0 ? 0.0F : 0.2F});
          (void)store.sample(0, {u, u}, TextureUse::data);
        }
        (void)store.image(0);
      } catch (const TextureError&) {
      }
    }
  }
}

TEST_CASE("Look-ups give the same from any number of threads, whatever fits the cache",
          "[threads]") {
  const ImageFolder folder;
  const auto noise = [](int x, int y, int c) {
    return static_cast<float>((x * 7919 + y * 104729 + c * 31) % 256) / 255.0F;
  };
  // 1024^2 texels of 6 bytes as half: six times the size of the small cache.
  const fs::path file = folder.write("a.tif", 1024, 1024, 3, OIIO::TypeUInt8, noise, 64);
  TextureOptions small;
  small.cache_megabytes = 1;
  const TextureStore store = store_of({file});
  const TextureStore tight = store_of({file}, small);
  const auto at = [](const TextureStore& textures, std::size_t i) {
    const auto f = static_cast<float>(i);
    return textures.sample(0, {0.754877F * f, 0.569840F * f}, TextureUse::color,
                           Vec2{i % 3 == 0 ? 0.0F : 0.001F * static_cast<float>(i % 50)});
  };
  constexpr std::size_t count = 5000;
  std::vector<Vec4> expected(count);
  for (std::size_t i = 0; i < count; ++i) expected[i] = at(store, i);
  std::vector<Vec4> parallel(count);
  parallel_for(count, 16, [&](std::size_t i) { parallel[i] = at(tight, i); });
  CHECK(parallel == expected);
}

TEST_CASE("A picture inside of another file is read in any order") {
  const ImageFolder folder;
  for (const char* name : {"a.png", "a.jpg"}) {
    CAPTURE(name);
    // Each quarter has its own brightness and is larger than a tile.
    const fs::path file = folder.write(name, 300, 300, 3, OIIO::TypeUInt8, [](int x, int y, int) {
      return static_cast<float>(1 + (x >= 150 ? 1 : 0) + (y >= 150 ? 2 : 0)) / 5;
    });
    std::ifstream stream(file, std::ios::binary);
    ImageTexture image;
    image.file = "b.glb, image 0";
    image.color_space = ColorSpace::linear;
    image.bytes = std::make_shared<const std::string>(std::istreambuf_iterator<char>(stream),
                                                      std::istreambuf_iterator<char>());
    const TextureStore store(std::vector<Texture>{image});
    // Reads from the bottom, which is stored last, to the top.
    CHECK(store.sample(0, {0.25F, 0.25F}).x == Approx(0.6).margin(0.02));
    CHECK(store.sample(0, {0.75F, 0.25F}).x == Approx(0.8).margin(0.02));
    CHECK(store.sample(0, {0.25F, 0.75F}).x == Approx(0.2).margin(0.02));
    CHECK(store.sample(0, {0.75F, 0.75F}).x == Approx(0.4).margin(0.02));
  }
}
