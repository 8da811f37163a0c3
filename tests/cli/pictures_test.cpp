// The picture library is loaded when it is first needed.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "catch.hpp"
#include "program.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;

namespace fs = std::filesystem;

TEST_CASE("The program starts without OpenImageIO") {
  CHECK_FALSE(contains(read_file(pah::test::program()), "libOpenImageIO"));
}

TEST_CASE("Without its picture module the program reports an error instead of rendering") {
  const CurrentTemporaryFolder folder;
  fs::copy_file(pah::test::program(), "pahrender");
  write_file("scene.yaml", small_scene);
  const int status = std::system("./pahrender scene.yaml 2> err");
  CHECK(WEXITSTATUS(status) == 4);
  CHECK(contains(read_file("err"), "cannot load the picture library: libpahrender_pictures"));
  CHECK_FALSE(fs::exists("scene.png"));
}
