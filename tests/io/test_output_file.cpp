#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "catch.hpp"
#include "io/output_file.hpp"

namespace fs = std::filesystem;

namespace {

// An empty folder that is the current one as long as this lives.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("pah-output-" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directory(path_);
    fs::current_path(path_);
  }
  ~Folder() {
    fs::current_path(before_);
    fs::remove_all(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] auto count() const {
    return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
  }

 private:
  fs::path before_ = fs::current_path();
  fs::path path_;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a file is replaced as a whole, and nothing stays beside it") {
  const Folder folder;
  pah::write_text_file("a.json", "first, and long");
  CHECK(text_of("a.json") == "first, and long");
  pah::write_text_file("a.json", "second");
  CHECK(text_of("a.json") == "second");
  CHECK(folder.count() == 1);
}

TEST_CASE("checking that a file can be created leaves no trace") {
  const Folder folder;
  pah::check_can_create("a.json");
  CHECK(folder.count() == 0);
  pah::write_text_file("a.json", "old");
  pah::check_can_create("a.json");
  CHECK(text_of("a.json") == "old");
}

TEST_CASE("what cannot be created is an error") {
  const Folder folder;
  fs::create_directory("folder");
  std::ofstream("file") << "";
  for (const char* file : {"folder", "missing/a.json", "file/a.json", "", "folder/"}) {
    CAPTURE(file);
    CHECK_THROWS_AS(pah::check_can_create(file), pah::FileError);
    CHECK_THROWS_AS(pah::write_text_file(file, "x"), pah::FileError);
  }
  CHECK(folder.count() == 2);
}

TEST_CASE("a link stays a link, and a device a device") {
  const Folder folder;
  std::ofstream("target") << "old";
  fs::create_symlink("target", "link");
  pah::write_text_file("link", "new");
  CHECK(fs::is_symlink("link"));
  CHECK(text_of("target") == "new");

  pah::check_can_create("/dev/null");
  pah::write_text_file("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a full disk is an error") {
  if (!fs::is_character_file("/dev/full")) {
    WARN("skipped: there is no /dev/full here");
    return;
  }
  CHECK_THROWS_AS(pah::write_text_file("/dev/full", "x"), pah::FileError);
}
