// Scenes with pictures that cannot be used.
#include "catch.hpp"
#include "scene_testing.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;

namespace {

// Returns the errors of a scene that uses a picture twice.
std::string errors_with(const std::string& bytes, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", bytes);
  const auto scene = write_text(folder / "scene.yaml",
                                "lights: [{type: environment, image: a.png}]\n"
                                "textures: {t: {type: image, file: a.png}}\n");
  return errors_in(scene, options);
}

}  // namespace

TEST_CASE("A picture that cannot be decoded is an error where it is first named") {
  const std::string where = "scene.yaml:2:35: error: cannot read image 'a.png': ";
  const std::string whole = test::png(1, 1, false, test::one_gray_pixel);
  CHECK(errors_with(whole).empty());
  CHECK(errors_with(whole.substr(0, 45)) == where + "the file ends early\n");
  // All chunks exist, but some rows are missing.
  CHECK(errors_with(test::png(1, 2, false, test::one_gray_pixel)).starts_with(where));
  CHECK(errors_with(test::tga(4, 4, "too few")).starts_with(where));
}

TEST_CASE("NaNs in a picture are counted") {
  const TemporaryFolder folder;
  // Uncompressed RGBE: 2 x 1 pixels, the second with the largest value.
  write_text(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
                                   std::string("\x80\x80\x80\x81\xFF\xFF\0\xFF", 8));
  const auto scene = write_text(folder / "scene.yaml",
                                "textures: {t: {type: image, file: a.hdr}}\n"
                                "meshes: [{shape: box}]\nlights: [{type: point}]\n");
  const LoadedScene loaded = load_scene(scene);
  REQUIRE(loaded.warnings.size() == 1);
  CHECK(loaded.warnings[0].where.line == 1);
  CHECK(loaded.warnings[0].where.column == 35);
  CHECK(loaded.warnings[0].message ==
        "image 'a.hdr' has 2 values that are infinite, too large or not a number; they count as 0");
  CHECK_THAT(format_warning(loaded.warnings[0]), contains_text("scene.yaml:1:35: warning: image"));
}

TEST_CASE("The limit is of a picture as floats") {
  LoadOptions options;
  options.limits.image_bytes = 1000;
  const std::string texels(5 * 5 * 3, 'x');
  CHECK(errors_with(test::tga(5, 5, texels), options).empty());
  CHECK(errors_with(test::tga(10, 9, texels + texels + texels + texels), options) ==
        "scene.yaml:2:35: error: cannot read image 'a.png': 10 x 9 pixels of 3 channels are more "
        "than 1000 bytes as RGB floats\n");
}
