// Ctrl-C, SIGTERM, and the progress bar.
#include <signal.h>

#include <chrono>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

const Words endless{"scene.yaml", "-o", "out.exr", "--spp", "1000000000"};

}  // namespace

TEST_CASE("A signal saves what there is and exits with 130") {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const CurrentTemporaryFolder folder;
    write_file("scene.yaml", small_scene);
    Program program(endless, ErrorStream::terminal);
    REQUIRE(program.wait_for_error_text("samples"));
    program.signal(number);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("wrote out.exr: ") != std::string::npos);
    CHECK(outcome.err.find(" of 1000000000 samples") != std::string::npos);
    CHECK(files() == Words{"out.exr", "scene.yaml"});
    CHECK(pah::read_image("out.exr").width == 32);
  }
}

TEST_CASE("A second signal ends the program at once") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  Program program(endless, ErrorStream::terminal);
  REQUIRE(program.wait_for_error_text("samples"));
  // Two equal signals could be delivered as one.
  program.signal(SIGINT);
  program.signal(SIGTERM);
  const Outcome outcome = program.wait();
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("wrote") == std::string::npos);
  CHECK(files() == Words{"scene.yaml"});
}

TEST_CASE("The progress bar shows on a terminal only, and not if asked to be quiet") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words arguments{"scene.yaml", "-o", "out.png", "--spp", "64"};
  const Outcome shown = run(arguments, ErrorStream::terminal);
  CHECK(shown.exit_code == 0);
  CHECK(shown.err.find("/64 samples") != std::string::npos);
  CHECK(shown.err.find("rays/s") != std::string::npos);
  CHECK(run(arguments).err.find("/64 samples") == std::string::npos);
  Words quietly = arguments;
  quietly.emplace_back("--quiet");
  CHECK(run(quietly, ErrorStream::terminal).err.empty());
}

TEST_CASE("An interrupt before every pixel has a sample leaves an old picture as it was") {
  const CurrentTemporaryFolder folder;
  // A pass takes long, as the picture is large and full of glass.
  write_file("scene.yaml",
             "film: {width: 2048, height: 2048}\nrender: {samples: 1000, max_depth: 64}\n"
             "materials: {g: {type: glass}}\n"
             "meshes: [{shape: sphere, material: g, transform: {scale: 5}}]\n"
             "lights: [{type: environment}]\n");
  write_file("out.exr", "an old picture");
  Program program({"scene.yaml", "-o", "out.exr", "--threads", "1"}, ErrorStream::terminal);
  REQUIRE(program.wait_for_error_text("samples"));
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("out.exr is unchanged") != std::string::npos);
  CHECK(read_file("out.exr") == "an old picture");
}

TEST_CASE("An interrupt before anything is rendered ends the program at once") {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", "meshes: [{shape: box}]\n");
  write_file("out.exr", "an old picture");
  for (const int number : {SIGINT, SIGTERM}) {
    // The signal comes before the first sample: allocating this film alone takes longer.
    Program program({"scene.yaml", "-o", "out.exr", "--width", "4096", "--height", "4096"},
                    ErrorStream::terminal);
    REQUIRE(program.wait_for_error_text("the scene has no light"));
    program.signal(number);
    const Clock::time_point signaled = Clock::now();
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(Clock::now() - signaled < milliseconds(500));
    CHECK(outcome.exit_code == 130);
    CHECK(read_file("out.exr") == "an old picture");
    CHECK(files() == Words{"out.exr", "scene.yaml"});
  }
}

TEST_CASE("The time limit counts loading and building too") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome =
      run({"scene.yaml", "-o", "a.png", "--time-limit", "0.000001", "--spp", "100000000"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find(", 1 of 100000000 samples") != std::string::npos);
}
