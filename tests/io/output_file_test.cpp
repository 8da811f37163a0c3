#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

#include "catch.hpp"
#include "io/output_file.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using pah::CurrentTemporaryFolder;

namespace {

auto count_files() { return std::distance(fs::directory_iterator("."), fs::directory_iterator()); }

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a file is replaced as a whole, and nothing stays beside it") {
  const CurrentTemporaryFolder folder;
  pah::write_text_file("a.json", "first, and long");
  CHECK(text_of("a.json") == "first, and long");
  pah::write_text_file("a.json", "second");
  CHECK(text_of("a.json") == "second");
  CHECK(count_files() == 1);
}

TEST_CASE("checking that a file can be created leaves no trace") {
  const CurrentTemporaryFolder folder;
  pah::check_can_create("a.json");
  CHECK(count_files() == 0);
  pah::write_text_file("a.json", "old");
  pah::check_can_create("a.json");
  CHECK(text_of("a.json") == "old");
}

TEST_CASE("what cannot be created is an error") {
  const CurrentTemporaryFolder folder;
  fs::create_directory("folder");
  std::ofstream("file") << "";
  for (const char* file : {"folder", "missing/a.json", "file/a.json", "", "folder/"}) {
    CAPTURE(file);
    CHECK_THROWS_AS(pah::check_can_create(file), pah::FileError);
    CHECK_THROWS_AS(pah::write_text_file(file, "x"), pah::FileError);
  }
  CHECK(count_files() == 2);
}

TEST_CASE("a link stays a link") {
  const CurrentTemporaryFolder folder;
  std::ofstream("target") << "old";
  fs::create_symlink("target", "link");
  pah::write_text_file("link", "new");
  CHECK(fs::is_symlink("link"));
  CHECK(text_of("target") == "new");
}

TEST_CASE("a device stays a device, and an open file keeps what it holds") {
  const CurrentTemporaryFolder folder;
  pah::check_can_create("/dev/null");
  pah::write_text_file("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));

  // As after a shell's `> shared`, which is what /dev/stdout may lead to.
  std::FILE* shared = std::fopen("shared", "w");
  REQUIRE(shared != nullptr);
  std::fputs("before ", shared);
  std::fflush(shared);
  const std::string name = "/dev/fd/" + std::to_string(::fileno(shared));
  pah::check_can_create(name);
  pah::write_text_file(name, "after");
  std::fclose(shared);
  CHECK(text_of("shared") == "before after");
  CHECK(count_files() == 1);
}

TEST_CASE("a full disk is an error") {
  if (!fs::is_character_file("/dev/full")) {
    WARN("skipped: there is no /dev/full here");
    return;
  }
  CHECK_THROWS_AS(pah::write_text_file("/dev/full", "x"), pah::FileError);
}
