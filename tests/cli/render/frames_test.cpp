// --frames: the pictures of an animation.
#include "cli/render/frames.hpp"

#include <filesystem>
#include <fstream>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/fewer.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using pah::cli::numbered;
using Words = std::vector<std::string>;

namespace {

// Returns arguments that animate the small scene by -D.
Words frames(const std::string& range, const Words& options) {
  Words words{"scene.yaml",
              "--frames",
              range,
              "--width",
              "16",
              "--spp",
              "4",
              "-D",
              "film.exposure=frame / 8",
              "-D",
              "camera.fov=30 + 4 * time"};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

Words replaced(Words words, const std::string& from, const std::string& to) {
  std::ranges::replace(words, from, to);
  return words;
}

auto pixels(const std::string& file) { return pah::read_image(file).pixels; }

}  // namespace

TEST_CASE("A frame's number replaces #") {
  CHECK(numbered("frame_####.png", 7) == "frame_0007.png");
  CHECK(numbered("a/frame_####.png", 12345) == "a/frame_12345.png");
  CHECK(numbered("#.png", 0) == "0.png");
  CHECK(numbered("##", 3) == "03");
  CHECK(numbered("a#b##c.png", 3) == "a#b03c.png");
  CHECK(numbered("a#/b.png", 3) == "a#/b.png");
  CHECK(numbered("out.png", 3) == "out.png");
  CHECK(numbered("", 3).empty());
}

TEST_CASE("Every frame is the picture of the scene at that frame") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run(frames("3:6", {"-o", "f_##.exr"}));
  REQUIRE(outcome.exit_code == 0);
  CHECK(files() == Words{"f_03.exr", "f_04.exr", "f_05.exr", "scene.yaml"});
  CHECK(pixels("f_03.exr") != pixels("f_04.exr"));
  Words one = frames("4", {"-o", "one.exr", "--quiet"});
  one.insert(one.end(), {"-D", "animation.frame=4"});
  REQUIRE(run(one).exit_code == 0);
  CHECK(pixels("one.exr") == pixels("f_04.exr"));
  Words by_key = frames("4", {"-o", "key.exr", "--quiet"});
  by_key.erase(by_key.begin() + 1, by_key.begin() + 3);
  by_key.insert(by_key.end(), {"-D", "animation.frame=4"});
  REQUIRE(run(by_key).exit_code == 0);
  CHECK(pixels("key.exr") == pixels("f_04.exr"));
}

TEST_CASE("Complete frames are kept, and others are rendered") {
  // Under sanitizers programs take long to start.
  const Words extensions = pah::test::sanitized ? Words{".png"} : Words{".png", ".exr", ".film"};
  for (const std::string& extension : extensions) {
    const CurrentTemporaryFolder folder;
    write_file("scene.yaml", small_scene);
    Words words = frames("0:4", {"-o", "f#" + extension});
    if (extension == ".film") {
      words.erase(std::ranges::find(words, "--spp"), std::ranges::find(words, "--spp") + 2);
      words.insert(words.end(), {"--samples", "2:5"});
    }
    REQUIRE(run(words).exit_code == 0);
    const auto file = [&](int frame) { return "f" + std::to_string(frame) + extension; };
    const std::string whole = read_file(file(1));
    fs::remove(file(3));
    fs::resize_file(file(2), fs::file_size(file(2)) - 40);
    write_file(file(0), "not a picture");
    const Outcome again = run(words);
    CHECK(again.exit_code == 0);
    for (const int frame : {0, 2, 3}) CHECK(contains(again.err, "wrote " + file(frame)));
    CHECK(contains(again.err, file(1) + " is already complete\n"));
    CHECK(read_file(file(1)) == whole);
    const Outcome third = run(words);
    CHECK_FALSE(contains(third.err, "wrote"));
  }
}

TEST_CASE("Frames of other settings are rendered again") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words words = frames("5", {"-o", "f#.png"});
  REQUIRE(run(words).exit_code == 0);
  const auto is_kept = [&](const Words& others) {
    const Outcome outcome = run(others);
    CHECK(outcome.exit_code == 0);
    REQUIRE(run(words).exit_code == 0);
    return !contains(outcome.err, "wrote");
  };
  const auto with = [&](const Words& options) {
    Words extended = words;
    extended.insert(extended.end(), options.begin(), options.end());
    return extended;
  };
  CHECK(is_kept(with({"--threads", "1", "--accel", "bvh"})));
  CHECK_FALSE(is_kept(replaced(words, "4", "5")));    // samples
  CHECK_FALSE(is_kept(replaced(words, "16", "20")));  // width
  if (pah::test::sanitized) return;
  CHECK_FALSE(is_kept(with({"--exposure", "1"})));
  CHECK_FALSE(is_kept(with({"--seed", "1"})));
  CHECK_FALSE(is_kept(with({"--png-bits", "16"})));
  CHECK_FALSE(is_kept(with({"--crop", "0,8,0,8"})));
  CHECK_FALSE(is_kept(with({"-D", "camera.position=[0, 1, 4.5]"})));
}

TEST_CASE("Several frames need several files") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const auto error_of = [](const Words& words) {
    const Outcome outcome = run(words);
    CHECK(outcome.exit_code == 2);
    return outcome.err;
  };
  CHECK(contains(
      error_of(frames("0:2", {"-o", "a/out.png"})),
      "-o a/out.png names one file for 2 frames; name one for each frame: a/out_####.png"));
  CHECK(
      contains(error_of(frames("0:2", {"-o", "f#.png", "--stats", "s.json"})),
               "--stats s.json names one file for 2 frames; name one for each frame: s_####.json"));
  for (const std::string range : {"2:2", "-1:2", "1:", ":1", "a:b", "1:2:3", "1.5", ""})
    CHECK(contains(error_of(frames(range, {"-o", "f#.png"})), "--frames"));
  CHECK(files() == Words{"scene.yaml"});
  REQUIRE(run(frames("1", {"-o", "out.png"})).exit_code == 0);
  REQUIRE(run(frames("1:3", {"--stats", "#.json", "--quiet"})).exit_code == 0);
  CHECK(files() ==
        Words{"1.json", "2.json", "out.png", "scene.yaml", "scene_0001.png", "scene_0002.png"});
}

TEST_CASE("Frames of a scene without movement cause a warning") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "--frames", "3", "--width", "8", "--spp", "1"});
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "warning: nothing in the scene depends on the frame\n"));
}

TEST_CASE("An error at one frame ends the animation there") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  Words words = frames("0:5", {"-o", "f#.png"});
  words.insert(words.end(), {"-D", "camera.fov=20 - 10 * frame"});
  const Outcome outcome = run(words);
  CHECK(outcome.exit_code == 3);
  CHECK(contains(outcome.err, "not 0, which is 20 - 10 * frame"));
  CHECK(files() == Words{"f0.png", "f1.png", "scene.yaml"});
}
