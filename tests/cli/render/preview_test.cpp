// --preview: a small picture with few samples.
#include "cli/render/preview.hpp"

#include <nlohmann/json.hpp>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;
using pah::Image;
using Words = std::vector<std::string>;

namespace {

struct Shown {
  Image image;
  int samples = 0;
};

Shown render(Words arguments) {
  write_file("scene.yaml", small_scene);  // 32 x 24, 4 samples
  for (const char* word : {"scene.yaml", "-o", "out.exr", "--stats", "stats.json", "--quiet"})
    arguments.emplace_back(word);
  const Outcome outcome = run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return {pah::read_image("out.exr"), nlohmann::json::parse(read_file("stats.json"))["samples"]};
}

}  // namespace

TEST_CASE("A preview has a quarter of the width and height, and four samples") {
  const CurrentTemporaryFolder folder;
  const auto check = [](const Words& arguments, int width, int height, int samples) {
    const Shown shown = render(arguments);
    CHECK(shown.image.width == width);
    CHECK(shown.image.height == height);
    CHECK(shown.samples == samples);
  };
  check({"--preview", "-D", "render.samples=9"}, 8, 6, 4);
  check({"--preview", "--spp", "7"}, 8, 6, 7);
  check({"--preview", "--width", "64"}, 16, 12, 4);
  check({"--preview", "--width", "5", "--height", "1"}, 2, 1, 4);
}

TEST_CASE("A preview is the picture that a film of its size has") {
  const CurrentTemporaryFolder folder;
  CHECK(render({"--preview", "--width", "64", "--spp", "2"}).image.pixels ==
        render({"--width", "16", "--spp", "2"}).image.pixels);
}

TEST_CASE("A crop of a preview is that part of the preview") {
  const CurrentTemporaryFolder folder;
  const Image whole = render({"--preview", "--width", "128"}).image;
  const Image part = render({"--preview", "--width", "128", "--crop", "7,18,16,96"}).image;
  REQUIRE(part.width == 4);    // from 1 to 5
  REQUIRE(part.height == 20);  // from 4 to 24
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) CHECK(part.at(x, y) == whole.at(x + 1, y + 4));
}

TEST_CASE("A crop is in pixels of the picture, not of its preview") {
  const CurrentTemporaryFolder folder;
  CHECK(render({"--preview", "--crop", "24,32,0,24"}).image.width == 2);
  const Outcome outcome = run({"scene.yaml", "-o", "out.exr", "--preview", "--crop", "24,33,0,24"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("reaches beyond the 32 x 24 picture") != std::string::npos);
}

TEST_CASE("The crop of a preview lies within it, whatever the sizes") {
  for (int size = 1; size < 20; ++size) {
    for (int end = 1; end <= size; ++end) {
      pah::FilmSettings film;
      film.width = film.height = size;
      film.crop = pah::PixelRect{end - 1, end, 0, end};
      film = pah::cli::preview_of(film);
      CHECK(film.crop->x0 < film.crop->x1);
      CHECK(film.crop->x1 <= film.width);
      CHECK(film.crop->y1 <= film.height);
    }
  }
}
