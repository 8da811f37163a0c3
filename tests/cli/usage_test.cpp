// Messages and exit codes of a program that does not get to render.
#include <sys/resource.h>

#include <filesystem>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/picture_bytes.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

// Checks that the program fails, prints nothing on stdout and leaves no file behind.
void check_failure(const Words& arguments, int exit_code, const std::string& message) {
  const auto before = files();
  const Outcome outcome = run(arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, message));
  CHECK(files() == before);
}

}  // namespace

TEST_CASE("Help and version go to stdout") {
  const CurrentTemporaryFolder folder;
  for (const char* option : {"--help", "-h"}) {
    const Outcome help = run({option});
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    for (const char* part : {"--spp", "--time-limit", "--accel", "brute_force", "compare", "130"})
      CHECK(contains(help.out, part));
  }
  const Outcome version = run({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out.starts_with("pahrender "));
}

TEST_CASE("Wrong usage exits with 2 and says what is wrong") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  check_failure({}, 2, "scene");
  check_failure({"--nope"}, 2, "--nope");
  check_failure({"scene.yaml", "--nope"}, 2, "--nope");
  check_failure({"scene.yaml", "other.yaml"}, 2, "other.yaml");
  check_failure({"scene.yaml", "--samples", "4"}, 2, "use --spp for a number of samples");
  for (const char* range : {"", "1", ":", "1:", ":1", "1:1", "2:1", "-1:1", "0:1x", "0:9999999999"})
    check_failure({"scene.yaml", "-o", "a.film", "--samples", range}, 2, "--samples");
  check_failure({"scene.yaml", "--samples", "0:4"}, 2, "--samples is for .film files");
  check_failure({"scene.yaml", "-o", "a.film", "--samples", "0:4", "--spp", "4"}, 2, "--spp");
  check_failure({"merge", "-o", "a.png"}, 2, "PART");
  check_failure({"merge", "a.film"}, 2, "--output");
  check_failure({"--spp", "4", "merge", "a.film", "-o", "a.png"}, 2, "cannot be used with merge");
  check_failure({"scene.yaml", "--checkpoint", "-1"}, 2, "--checkpoint");
  check_failure({"scene.yaml", "--seeds=4"}, 2, "did you mean '--seed'?");
  check_failure({"render", "scene.yaml"}, 2, "no command 'render': pahrender SCENE -o OUT");
  check_failure({"scene.yaml", "-o"}, 2, "--output");
  check_failure({"scene.yaml", "-o", "out.xyz"}, 2, ".exr");
  check_failure({"scene.yaml", "-o", "out"}, 2, ".exr");
  check_failure({"scene.yaml", "-o", "there.d/"}, 2,
                "-o there.d/ is a directory; name a file in it: there.d/scene.png");
  std::filesystem::create_directory("there");
  check_failure({"scene.yaml", "-o", "there"}, 2,
                "-o there is a directory; name a file in it: there/scene.png");
  check_failure({"scene.yaml", "-o", "."}, 2, "name a file in it: ./scene.png");
  check_failure({"scene.yaml", "--accel", "magic"}, 2, "bvh, local, light, brute_force");
  check_failure({"scene.yaml", "--spp", "0"}, 2, "--spp");
  check_failure({"scene.yaml", "--spp", "many"}, 2, "--spp");
  check_failure({"scene.yaml", "--width", "65537"}, 2, "--width");
  check_failure({"scene.yaml", "--height", "0"}, 2, "--height");
  check_failure({"scene.yaml", "--width", "65536", "--height", "65536"}, 2, "too large");
  check_failure({"scene.yaml", "--width", "1000", "-D", "film.width=1", "-D", "film.height=100"}, 2,
                "1000 x 100000 pixels is too large");
  check_failure({"scene.yaml", "--width", "16", "--crop", "0,17,0,12"}, 2, "16 x 12");
  check_failure({"scene.yaml", "--threads", "-1"}, 2, "--threads");
  check_failure({"scene.yaml", "--seed", "-1"}, 2, "--seed");
  check_failure({"scene.yaml", "--time-limit", "nan"}, 2, "--time-limit");
  check_failure({"scene.yaml", "--exposure", "inf"}, 2, "--exposure");
  for (const char* crop : {"", "1,2,3", "0,1,0,1,", "0,0,0,1", "2,1,0,1", "-1,1,0,1", "a,b,c,d"})
    check_failure({"scene.yaml", "--crop", crop}, 2, "--crop");
  check_failure({"scene.yaml", "--crop", "0,33,0,24"}, 2, "crop");
  check_failure({"scene.yaml", "--png-bits", "12"}, 2, "--png-bits");
  check_failure({"scene.yaml", "-o", "out.exr", "--png-bits", "16"}, 2, "--png-bits is for .png");
  check_failure({"scene.yaml", "--half"}, 2, "--half is for .exr files; the output is scene.png");
  check_failure({"scene.yaml", "-o", "out.tif", "--half"}, 2, "--half");
  check_failure({"--spp", "4", "compare", "a.png", "b.png"}, 2, "--spp");
}

TEST_CASE("Scenes that cannot be read exit with 4") {
  const CurrentTemporaryFolder folder;
  std::filesystem::create_directory("folder");
  check_failure({"missing.yaml"}, 4, "missing.yaml");
  check_failure({"folder"}, 4, "folder");
  check_failure({"missing.yaml", "--check"}, 4, "missing.yaml");
}

TEST_CASE("Outputs that cannot be written are found before the scene is read") {
  const CurrentTemporaryFolder folder;
  std::filesystem::create_directory("folder.png");
  write_file("file", "");
  for (const char* out : {"missing/out.png", "folder.png", "file/out.png"})
    check_failure({"missing.yaml", "-o", out}, 4, out);
  for (const char* stats : {"missing/stats.json", "folder.png", "file/stats.json"})
    check_failure({"missing.yaml", "-o", "out.png", "--stats", stats}, 4, stats);
}

TEST_CASE("All errors of a scene are reported, each with its place") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml",
             "film: {width: 0}\n"
             "render: {sampels: 4}\n"
             "meshes:\n"
             "  - {name: bust, file: missing.obj}\n");
  for (const Words& arguments : {Words{"scene.yaml"}, Words{"scene.yaml", "--check"}}) {
    check_failure(arguments, 3, "scene.yaml:1:");
    check_failure(arguments, 3, "scene.yaml:2:");
    check_failure(arguments, 3, "did you mean 'samples'?");
    check_failure(arguments, 3, "missing.obj");
  }
}

TEST_CASE("A wrong override is an error of the scene") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  check_failure({"scene.yaml", "-D", "render.sampels=4"}, 3, "sampels");
  check_failure({"scene.yaml", "-D", "film.width=-3"}, 3, "width");
}

TEST_CASE("A picture that ends early is an error of the scene, with and without --check") {
  const CurrentTemporaryFolder folder;
  write_file("sky.tga", pah::test::tga(4, 4, "too few"));
  write_file("scene.yaml", "lights: [{type: environment, image: sky.tga}]\n");
  check_failure({"scene.yaml"}, 3, "scene.yaml:1:37: error: cannot read image 'sky.tga'");
  check_failure({"scene.yaml", "--check"}, 3, "scene.yaml:1:37: error: cannot read image");
}

TEST_CASE("A picture with infinite values causes a warning, unless --quiet") {
  const CurrentTemporaryFolder folder;
  write_file("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\xFF\xFF\xFF\xFF");
  write_file("scene.yaml", "lights: [{type: environment, image: sky.hdr}]\n");
  const Outcome outcome = run({"scene.yaml", "--check"});
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "scene.yaml:1:37: warning: image 'sky.hdr' has 3 values"));
  CHECK(run({"scene.yaml", "--check", "--quiet"}).err.empty());
}

TEST_CASE("Option --check loads and writes nothing") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "--check", "-o", "out.png", "--stats", "stats.json"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, "no errors"));
  CHECK(files() == Words{"scene.yaml"});

  const Outcome quiet = run({"scene.yaml", "--check", "--quiet"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.err.empty());
}

TEST_CASE("A closed or full stderr changes no exit code and no picture") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  write_file("bad.yaml", "film: [");
  REQUIRE(run({"scene.yaml", "-o", "a.png"}).exit_code == 0);
  for (const ErrorStream stream : {ErrorStream::closed, ErrorStream::full}) {
    CHECK(run({"scene.yaml", "-o", "b.png"}, stream).exit_code == 0);
    CHECK(pah::read_image("a.png").pixels == pah::read_image("b.png").pixels);
    CHECK(run({"scene.yaml", "--nope"}, stream).exit_code == 2);
    CHECK(run({"bad.yaml"}, stream).exit_code == 3);
    CHECK(run({"none.yaml"}, stream).exit_code == 4);
  }
}

TEST_CASE("Outputs that would overwrite one another or a device are refused") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  check_failure({"scene.yaml", "-o", "a.png", "--stats", "./a.png"}, 2, "name the same file");
  std::filesystem::create_symlink("/dev/null", "null.tif");
  check_failure({"scene.yaml", "-o", "null.tif"}, 4, "a TIFF file cannot be written to a device");
  CHECK(std::filesystem::is_symlink("null.tif"));
}

// Sanitizers reserve terabytes of address space.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PAH_UNLIMITED_ADDRESSES
#endif
#endif
#ifndef PAH_UNLIMITED_ADDRESSES
namespace {

// Runs the program with `bytes` of address space.
Outcome run_within(rlim_t bytes, const Words& arguments) {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
  rlimit less = before;
  less.rlim_cur = bytes;
  REQUIRE(::setrlimit(RLIMIT_AS, &less) == 0);
  Outcome outcome = run(arguments);
  REQUIRE(::setrlimit(RLIMIT_AS, &before) == 0);
  return outcome;
}

}  // namespace

TEST_CASE("A film that exceeds the memory is refused with a plain message") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const auto check_needed = [](const char* output, const char* needed) {
    const Outcome outcome =
        run_within(4'000'000'000, {"scene.yaml", "-o", output, "--width", "16384", "--height",
                                   "8192", "-D", "film.channels=[depth]"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK(contains(outcome.err, std::string("a film of 16384 x 8192 pixels takes ") + needed +
                                    " GB of memory, and "));
  };
  check_needed("a.exr", "18.3");
  check_needed("a.png", "10.7");  // cannot hold layers
}

TEST_CASE("Too many threads for the memory end the program without an abort") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run_within(
      2'000'000'000, {"scene.yaml", "-o", "a.png", "--width", "2048", "--threads", "1024"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(contains(outcome.err, "see --threads"));
}
#endif
