// pahrender watch: pictures are rendered again when files change.
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <pah/image/image_file.hpp>
#include <thread>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

namespace {

const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

void write_scene(int width, int samples = 1) {
  write_file("scene.yaml", "film: {width: " + std::to_string(width) +
                               ", height: 8}\n"
                               "render: {samples: " +
                               std::to_string(samples) +
                               "}\nmeshes: [{file: mesh.obj}]\nlights: [{type: environment}]\n");
}

template <typename Condition>
bool wait_until(const Condition& condition) {
  const Clock::time_point start = Clock::now();
  while (!condition()) {
    if (Clock::now() - start > std::chrono::seconds(60)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

// Safe while the program writes, as it replaces the file as a whole.
bool shows(int width) { return fs::exists("out.exr") && pah::read_image("out.exr").width == width; }

int end(Program& program) {
  program.signal(SIGINT);
  return program.wait().exit_code;
}

}  // namespace

TEST_CASE("Watch renders again when the scene or a file that it names changes") {
  const CurrentTemporaryFolder folder;
  write_file("mesh.obj", triangle);
  write_scene(10);
  Program program({"watch", "scene.yaml", "-o", "out.exr"});
  REQUIRE(wait_until([] { return shows(10); }));
  write_scene(11);
  REQUIRE(wait_until([] { return shows(11); }));
  fs::remove("out.exr");
  write_file("mesh.obj", std::string(triangle) + "v 1 1 0\n");
  REQUIRE(wait_until([] { return shows(11); }));
  CHECK(end(program) == 130);
  CHECK(files() == Words{"mesh.obj", "out.exr", "scene.yaml"});
}

TEST_CASE("Watch stops an outdated render without saving it") {
  const CurrentTemporaryFolder folder;
  write_file("mesh.obj", triangle);
  write_scene(10, 1'000'000'000);
  Program program({"watch", "scene.yaml", "-o", "out.exr", "--write-every", "1000"});
  REQUIRE(wait_until([] { return shows(10); }));
  fs::remove("out.exr");
  write_scene(11);
  REQUIRE(wait_until([] { return fs::exists("out.exr"); }));
  CHECK(shows(11));
  SECTION("a signal during a later render saves and ends as ever") {
    write_scene(12, 1'000'000'000);
    REQUIRE(wait_until([] { return shows(12); }));
    fs::remove("out.exr");
    CHECK(end(program) == 130);
    CHECK(shows(12));
  }
}

TEST_CASE("Watch prints errors and waits until they are fixed") {
  const CurrentTemporaryFolder folder;
  write_scene(10);
  Program program({"watch", "scene.yaml", "-o", "out.exr"}, ErrorStream::terminal);
  REQUIRE(program.wait_for_error_text("file 'mesh.obj' does not exist"));
  write_file("mesh.obj", triangle);
  REQUIRE(wait_until([] { return shows(10); }));
  write_file("scene.yaml", "film: {widht: 3}\n");
  REQUIRE(program.wait_for_error_text("did you mean 'width'?"));
  write_scene(11);
  REQUIRE(wait_until([] { return shows(11); }));
  CHECK(end(program) == 130);
}

TEST_CASE("Watch ends at once if no change of the scene would help") {
  const CurrentTemporaryFolder folder;
  CHECK(run({"watch"}).exit_code == 2);
  CHECK(run({"--spp", "1", "watch", "scene.yaml"}).exit_code == 2);
  write_file("mesh.obj", triangle);
  write_scene(10);
  CHECK(run({"watch", "scene.yaml", "-o", "out.png", "--half"}).exit_code == 2);
}
