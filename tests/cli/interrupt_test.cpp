// Ctrl-C, SIGTERM, and the progress bar, which tells when there is something to interrupt.
#include <signal.h>

#include <pah/io/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::testing;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

const Words endless{"scene.yaml", "-o", "out.exr", "--spp", "1000000000"};

}  // namespace

TEST_CASE("a signal saves what there is and exits with 130") {
  for (const int number : {SIGINT, SIGTERM}) {
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

TEST_CASE("a second signal ends the program at once") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  Program program(endless, ErrorStream::terminal);
  REQUIRE(program.wait_for_error_text("samples"));
  // Two of a kind could become one.
  program.signal(SIGINT);
  program.signal(SIGTERM);
  const Outcome outcome = program.wait();
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("wrote") == std::string::npos);
  CHECK(files() == Words{"scene.yaml"});
}

TEST_CASE("the progress bar shows on a terminal only, and not if asked to be quiet") {
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
