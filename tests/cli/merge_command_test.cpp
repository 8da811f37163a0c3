// Pictures merged from parts that were rendered separately.
#include <algorithm>
#include <cmath>
#include <pah/image/image_file.hpp>
#include <pah/render/film_file.hpp>

#include "catch.hpp"
#include "layer_pixels.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

void succeed(const Words& arguments) {
  const Outcome outcome = run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

void render_part(const std::string& file, const std::string& samples, const Words& options = {}) {
  Words arguments{"scene.yaml", "-o", file, "--samples", samples};
  arguments.insert(arguments.end(), options.begin(), options.end());
  succeed(arguments);
}

void check_refused(Words parts, const std::string& why) {
  parts.insert(parts.begin(), "merge");
  parts.insert(parts.end(), {"-o", "refused.exr"});
  const auto before = files();
  const Outcome outcome = run(parts);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 4);
  CHECK(contains(outcome.err, why));
  CHECK(files() == before);
}

bool same_picture(const std::string& a, const std::string& b) {
  return pah::read_image(a).pixels == pah::read_image(b).pixels;
}

// Sums of features and squares depend on the order of additions.
bool nearly_same_layers(const std::string& a, const std::string& b) {
  const auto near = [](float x, float y) { return std::abs(x - y) <= 1e-6F * std::abs(y) + 1e-9F; };
  return std::ranges::equal(layer_pixels(a), layer_pixels(b), near);
}

}  // namespace

TEST_CASE("Parts in several splits and orders give the picture of the whole") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words layers{"-D", "film.channels=[albedo,normal,depth,variance]"};
  Words whole{"scene.yaml", "-o", "whole.exr", "--spp", "61"};
  whole.insert(whole.end(), layers.begin(), layers.end());
  succeed(whole);
  const std::vector<Words> splits{{"1:61", "0:1"}, {"0:16", "32:48", "48:61", "16:32"}};
  for (const Words& split : splits) {
    Words merge{"merge", "-o", "merged.exr"};
    for (const std::string& samples : split) {
      merge.push_back("part" + std::to_string(merge.size()) + ".film");
      render_part(merge.back(), samples, layers);
    }
    const Outcome outcome = run(merge);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(contains(outcome.err, "wrote merged.exr: 32 x 24, 61 samples of "));
    CHECK(same_picture("merged.exr", "whole.exr"));
    CHECK(nearly_same_layers("merged.exr", "whole.exr"));
  }
}

TEST_CASE("Parts are merged in steps, and to any format") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render_part("a.film", "0:3");
  render_part("b.film", "3:8");
  render_part("c.film", "8:10");
  succeed({"merge", "b.film", "c.film", "-o", "bc.film"});
  succeed({"merge", "bc.film", "a.film", "-o", "merged.png"});
  succeed({"scene.yaml", "-o", "whole.png", "--spp", "10"});
  CHECK(same_picture("merged.png", "whole.png"));
  succeed({"merge", "bc.film", "a.film", "-o", "bright.png", "--exposure", "1"});
  succeed({"scene.yaml", "-o", "whole.png", "--spp", "10", "--exposure", "1"});
  CHECK(same_picture("bright.png", "whole.png"));
}

TEST_CASE("A film file has all samples by default") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  succeed({"scene.yaml", "-o", "all.film"});
  CHECK(pah::read_film("all.film").samples == pah::FilmSamples{0, 4, 0, {}});
}

TEST_CASE("Parts that overlap, are missing or of other renders are named") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render_part("a.film", "0:4");
  render_part("b.film", "4:8");
  render_part("c.film", "9:10");
  render_part("d.film", "6:10");
  check_refused({"a.film", "c.film", "b.film"}, "sample 8 is missing; render with --samples 8:9");
  check_refused({"b.film"}, "samples 0 to 3 are missing");
  check_refused({"d.film", "a.film", "b.film"}, "b.film and d.film overlap: both have sample 6");
  check_refused({"a.film", "a.film"}, "a.film and a.film overlap");
  check_refused({"a.film", "none.film"}, "none.film");
  check_refused({"a.film", "scene.yaml"}, "scene.yaml is not a pahrender film");

  render_part("seed.film", "4:8", {"--seed", "9"});
  check_refused({"a.film", "seed.film"}, "seed.film does not match a.film: the seed is 9, not 3");
  write_file("scene.yaml", std::string(small_scene) + "# another\n");
  render_part("scene.film", "4:8");
  check_refused({"a.film", "scene.film"}, "scene.film does not match a.film: the scene (its text");

  pah::FilmFile film = pah::read_film("b.film");
  pah::write_film("b.film", film.origin, {4, 8, 2, {0}}, film.film);
  check_refused({"a.film", "b.film"}, "b.film was stopped in the middle of a pass");
}

TEST_CASE("Parts by crops and samples give the picture of the whole") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words layers{"-D", "film.channels=[albedo,normal,depth]"};
  const auto with_layers = [&](Words words) {
    words.insert(words.end(), layers.begin(), layers.end());
    return words;
  };
  succeed(with_layers({"scene.yaml", "-o", "whole.exr", "--spp", "6"}));
  // Three crops: one as wide as the picture, and one in two parts.
  render_part("top.film", "0:6", with_layers({"--crop", "0,32,0,9"}));
  render_part("left.film", "0:6", with_layers({"--crop", "0,20,9,24"}));
  render_part("right_a.film", "0:2", with_layers({"--crop", "20,32,9,24"}));
  render_part("right_b.film", "2:6", with_layers({"--crop", "20,32,9,24"}));
  succeed({"merge", "right_b.film", "left.film", "top.film", "right_a.film", "-o", "merged.exr"});
  CHECK(same_picture("merged.exr", "whole.exr"));
  CHECK(nearly_same_layers("merged.exr", "whole.exr"));
  // A merged file is a part itself.
  succeed({"merge", "right_a.film", "right_b.film", "-o", "right.film"});
  const Outcome bottom = run({"merge", "right.film", "left.film", "-o", "bottom.film"});
  CHECK(bottom.exit_code == 0);
  CHECK(contains(bottom.err, "these are the pixels 0,32,9,24 of 32 x 24\n"));
  succeed({"merge", "bottom.film", "top.film", "-o", "merged.film"});
  CHECK(pah::read_film("merged.film").samples == pah::FilmSamples{0, 6, 0, {}});
  succeed({"merge", "merged.film", "-o", "merged.png"});
  succeed(with_layers({"scene.yaml", "-o", "whole.png", "--spp", "6", "--quiet"}));
  CHECK(same_picture("merged.png", "whole.png"));

  check_refused({"top.film", "left.film"},
                "the pixels 20,32,9,24 are missing; render them with --crop 20,32,9,24");
  check_refused(
      {"top.film", "left.film", "right_a.film"},
      "right_a.film has samples 0:2, and top.film has 0:6; every pixel needs the same samples");
  render_part("wide.film", "0:6", with_layers({"--crop", "12,32,9,24"}));
  check_refused({"top.film", "left.film", "wide.film"},
                "left.film and wide.film overlap: both have the pixels 12,20,9,24");
}
