// Renders that are stopped and resumed.
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <pah/render/film_file.hpp>
#include <random>
#include <thread>

#include "catch.hpp"
#include "layer_pixels.hpp"
#include "program.hpp"
#include "support/fewer.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

const char* const checkpoint = "out.exr.film";

Words operator+(Words words, const Words& suffix) {
  words.insert(words.end(), suffix.begin(), suffix.end());
  return words;
}

// Arguments that request all layers.
const Words layers{"-D", "film.channels=[albedo,normal,depth,variance]"};

void render(const Words& arguments) {
  const Outcome outcome = run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

// Compares pixels only, as the metadata contain the render time.
bool identical(const std::string& a, const std::string& b) {
  return layer_pixels(a) == layer_pixels(b);
}

// Interrupts a render, which leaves a checkpoint and a picture.
Outcome interrupt(const Words& arguments) {
  Program program(arguments, ErrorStream::terminal);
  REQUIRE(program.wait_for_error_text("samples"));
  program.signal(SIGINT);
  return program.wait();
}

const Words many{"scene.yaml", "-o", "out.exr", "--spp", "1000000000", "--checkpoint", "1000"};

int samples_kept() {
  const pah::FilmSamples samples = pah::read_film(checkpoint).samples;
  return samples.to + samples.ahead;
}

void check_refused(const Words& arguments, const std::string& why) {
  const std::string before = read_file(checkpoint);
  const Outcome outcome = run(arguments + Words{"--resume"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 4);
  CHECK(contains(outcome.err, "out.exr.film"));
  CHECK(contains(outcome.err, why));
  const bool untouched = read_file(checkpoint) == before;
  CHECK(untouched);
}

// In milliseconds. Under sanitizers the program takes longer to start.
constexpr unsigned latest_kill = pah::test::sanitized ? 2000 : 300;

// Kills a render at random moments until it gets to its end. Returns the number of kills.
int render_with_kills(const Words& arguments, int most, std::mt19937& random) {
  int kills = 0;
  for (; kills < most; ++kills) {
    Program program(arguments + Words{"--checkpoint", "0", "--resume"});
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % latest_kill));
    program.signal(SIGKILL);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    if (outcome.exit_code == 0) return kills;
    REQUIRE(outcome.exit_code == -1);
  }
  render(arguments + Words{"--checkpoint", "0", "--resume"});
  return kills;
}

void check_kills(int least) {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const std::string samples = std::to_string(pah::test::fewer_if_sanitized(3001));
  const Words scene = Words{"scene.yaml", "--spp", samples} + layers;
  render(scene + Words{"-o", "whole.exr"});
  std::mt19937 random(11);
  int kills = 0;
  while (kills < least) {
    kills += render_with_kills(scene + Words{"-o", "out.exr"}, least - kills, random);
    CHECK(identical("out.exr", "whole.exr"));
    CHECK(!fs::exists(checkpoint));
    fs::remove("out.exr");
  }
}

}  // namespace

TEST_CASE("A render that is killed at any moment goes on to the same picture") {
  check_kills(pah::test::sanitized ? 2 : 4);
}

TEST_CASE("A render that is killed 50 times goes on to the same picture", "[full]") {
  check_kills(50);
}

TEST_CASE("An interrupt leaves a checkpoint, from which any number of samples goes on") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = interrupt(many + layers);
  CHECK(outcome.exit_code == 130);
  CHECK(contains(outcome.err, "wrote out.exr.film; --resume continues from it"));
  CHECK(files() == Words{"out.exr", checkpoint, "scene.yaml"});

  const std::string samples = std::to_string(samples_kept() + 5);
  const Words rest = Words{"scene.yaml", "--spp", samples} + layers;
  const Outcome resumed = run(rest + Words{"-o", "out.exr", "--resume", "--threads", "1"});
  INFO(resumed.err);
  CHECK(resumed.exit_code == 0);
  CHECK(contains(resumed.err, "resuming from out.exr.film: "));
  CHECK(contains(resumed.err, "wrote out.exr: 32 x 24, " + samples + " samples"));
  CHECK(!fs::exists(checkpoint));
  render(rest + Words{"-o", "whole.exr"});
  CHECK(identical("out.exr", "whole.exr"));
}

TEST_CASE("A pass that is interrupted goes on with the tiles that lack it") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words large{"scene.yaml",
                    "--width",
                    "320",
                    "--height",
                    "240",
                    "-D",
                    "film.channels=[albedo,normal,depth,variance]"};
  bool behind = false;
  for (int attempt = 0; attempt < 20 && !behind; ++attempt) {
    interrupt(large + Words{"-o", "out.exr", "--spp", "1000000", "--checkpoint", "1000"});
    behind = !pah::read_film(checkpoint).samples.behind.empty();
  }
  CHECK(behind);
  const std::string samples = std::to_string(samples_kept() + 1);
  render(large + Words{"-o", "out.exr", "--spp", samples, "--resume"});
  render(large + Words{"-o", "whole.exr", "--spp", samples});
  CHECK(identical("out.exr", "whole.exr"));
}

TEST_CASE("A time limit leaves a checkpoint, too") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render(many + Words{"--time-limit", "0.0001"});
  CHECK(fs::exists(checkpoint));
}

TEST_CASE("Without a checkpoint a render starts over with a message") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "-o", "out.exr", "--resume", "--checkpoint", "5"});
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "out.exr.film does not exist; starting from the beginning"));
  CHECK(files() == Words{"out.exr", "scene.yaml"});
}

TEST_CASE("A checkpoint that will be replaced causes a warning") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  interrupt(many);
  const Outcome outcome = run({"scene.yaml", "-o", "out.exr", "--checkpoint", "5"});
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "use --resume to continue it"));
  CHECK(!fs::exists(checkpoint));
}

TEST_CASE("A checkpoint of another render is refused with the differences") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  interrupt(many);
  check_refused(many + Words{"--seed", "4"}, "the seed is 3, not 4");
  check_refused(many + Words{"--width", "64"}, "the width is 32, not 64");
  check_refused(many + Words{"--crop", "0,8,0,8"}, "the crop is 0,32,0,24, not 0,8,0,8");
  check_refused(many + Words{"-D", "render.max_depth=3"}, "max_depth is 4, not 3");
  check_refused(many + layers, "the layers kept beside the picture is nothing, not features");

  pah::FilmFile film = pah::read_film(checkpoint);
  pah::write_film(checkpoint, film.origin, {0, 5, 0, {}}, film.film);
  check_refused({"scene.yaml", "-o", "out.exr", "--spp", "4"},
                "it has samples up to 5, more than the 4 asked for");
  film.origin.version = "0.0.1";
  pah::write_film(checkpoint, film.origin, film.samples, film.film);
  check_refused(many, "the version of pahrender is 0.0.1, not ");

  write_file("scene.yaml", std::string(small_scene) + "# another\n");
  check_refused(many, "the scene (its text, the files that it names and -D) is ");
}

TEST_CASE("A damaged checkpoint is refused") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  interrupt(many);
  std::string bytes = read_file(checkpoint);
  bytes[bytes.size() / 2] ^= 1;
  write_file(checkpoint, bytes);
  check_refused(many, "is damaged");
  write_file(checkpoint, bytes.substr(0, bytes.size() / 2));
  check_refused(many, "is cut short");
  write_file(checkpoint, "not a film");
  check_refused(many, "is not a pahrender film");
}

TEST_CASE("A checkpoint that cannot be written causes one warning and keeps the picture") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  fs::create_directories("out.exr.film/in the way");
  const Outcome outcome = run({"scene.yaml", "-o", "out.exr", "--spp", "64", "--checkpoint", "0"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  const std::string warning = "cannot write out.exr.film: ";
  const std::size_t first = outcome.err.find(warning);
  REQUIRE(first != std::string::npos);
  CHECK(outcome.err.find(warning, first + 1) == std::string::npos);
  CHECK(contains(outcome.err, "; the render continues"));
  CHECK(files() == Words{"out.exr", checkpoint, "scene.yaml"});
}
