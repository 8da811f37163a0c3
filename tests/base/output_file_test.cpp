#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/output_file.hpp"
#include "catch.hpp"
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

TEST_CASE("A file is replaced as a whole, and nothing stays beside it") {
  const CurrentTemporaryFolder folder;
  pah::write_text_file("a.json", "first, and long");
  CHECK(text_of("a.json") == "first, and long");
  pah::write_text_file("a.json", "second");
  CHECK(text_of("a.json") == "second");
  CHECK(count_files() == 1);
}

TEST_CASE("The leftovers of a killed process are removed, and nothing else") {
  const CurrentTemporaryFolder folder;
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  REQUIRE(::waitpid(ended, nullptr, 0) == ended);
  const auto leave = [](const std::string& name, std::chrono::minutes age) {
    std::ofstream(name) << "half";
    fs::last_write_time(name, fs::file_time_type::clock::now() - age);
    return name;
  };
  using std::chrono::minutes;
  const std::string dead = std::to_string(ended);
  const std::string gone = leave(".a.b.part" + dead + ".film", minutes(2));
  const std::vector<std::string> kept{
      leave(".a.b.part" + std::to_string(::getppid()) + ".film", minutes(2)),
      leave(".a.b.part1.film", minutes(2)),
      leave(".a.b.part" + dead + ".json", minutes(2)),
      leave(".a.b.part" + dead + "x.film", minutes(2)),
      leave(".a.b.part.film", minutes(2)),
      leave(".a.b.part0.film", minutes(2)),
      leave(".a.b.part-" + dead + ".film", minutes(2)),
      leave(".a.part" + dead + ".film", minutes(2)),
      leave("a.b.part" + dead + ".film", minutes(2))};
  pah::write_text_file("a.b.film", "whole");
  CHECK(!fs::exists(gone));
  for (const std::string& name : kept) {
    CAPTURE(name);
    CHECK(fs::exists(name));
  }
  leave(gone, minutes(0));
  pah::write_text_file("a.b.film", "whole");
  CHECK(fs::exists(gone));
}

TEST_CASE("Checking that a file can be created leaves no trace") {
  const CurrentTemporaryFolder folder;
  pah::check_can_create("a.json");
  CHECK(count_files() == 0);
  pah::write_text_file("a.json", "old");
  pah::check_can_create("a.json");
  CHECK(text_of("a.json") == "old");
}

TEST_CASE("A file that cannot be created is an error") {
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

TEST_CASE("A link stays a link") {
  const CurrentTemporaryFolder folder;
  std::ofstream("target") << "old";
  fs::create_symlink("target", "link");
  pah::write_text_file("link", "new");
  CHECK(fs::is_symlink("link"));
  CHECK(text_of("target") == "new");
}

TEST_CASE("A device stays a device, and an open file keeps what it holds") {
  const CurrentTemporaryFolder folder;
  pah::check_can_create("/dev/null");
  pah::write_text_file("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));

  // /dev/stdout leads to such a file after a shell's `> shared`.
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

TEST_CASE("A full disk is an error") {
  if (!fs::is_character_file("/dev/full")) {
    WARN("skipped: there is no /dev/full here");
    return;
  }
  CHECK_THROWS_AS(pah::write_text_file("/dev/full", "x"), pah::FileError);
}
