// --write-every: the picture file while the render runs.
#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <pah/image/image_file.hpp>
#include <set>
#include <thread>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;
using Clock = std::chrono::steady_clock;

namespace {

// Returns arguments of an endless render whose passes take some hundredths of a second.
Words endless(const std::string& output) {
  write_file("scene.yaml", small_scene);
  return {"scene.yaml", "-o",         output,    "--width",       "160",
          "--spp",      "1000000000", "--quiet", "--write-every", "0.05"};
}

template <typename Condition>
bool wait_until(const Condition& condition) {
  const Clock::time_point start = Clock::now();
  while (!condition()) {
    if (Clock::now() - start > std::chrono::seconds(60)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

struct Seen {
  int samples = 0;  // from the metadata, if the format has them
  std::vector<float> pixels;
};

// Returns none if the file is incomplete.
std::optional<Seen> look_at(const std::string& file) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return std::nullopt;
  const OIIO::ImageSpec& spec = input->spec();
  Seen seen{std::stoi(spec.get_string_attribute("pahrender:samples", "0").c_str()), {}};
  seen.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, -1, OIIO::TypeFloat, seen.pixels.data())) return std::nullopt;
  return seen;
}

int samples_in(const std::string& file) { return look_at(file).value_or(Seen{}).samples; }

}  // namespace

TEST_CASE("A picture file is complete at every moment of a render") {
  for (const std::string output : {"out.exr", "out.tif"}) {
    const CurrentTemporaryFolder folder;
    Words arguments = endless(output);
    arguments.insert(arguments.end(), {"-D", "film.channels=[albedo, depth]"});
    if (output == "out.tif") arguments.resize(arguments.size() - 2);
    Program program(arguments);
    REQUIRE(wait_until([&] { return fs::exists(output); }));
    std::set<std::vector<float>> pictures;
    int samples = 0;
    bool whole = true;
    CHECK(wait_until([&] {
      const std::optional<Seen> seen = look_at(output);
      whole = seen && seen->samples >= samples;
      samples = whole ? seen->samples : 0;
      if (whole) pictures.insert(seen->pixels);
      return !whole || pictures.size() == 4;
    }));
    CHECK(whole);
    CHECK((output != "out.exr" || samples > 1));
    program.signal(SIGINT);
    CHECK(program.wait().exit_code == 130);
    CHECK(files() == Words{output, "scene.yaml"});
    CHECK(samples_in(output) >= samples);
  }
}

TEST_CASE("A picture has all its layers while it is rendered") {
  const CurrentTemporaryFolder folder;
  Words arguments = endless("out.exr");
  arguments.insert(arguments.end(), {"-D", "film.channels=[albedo, normal, depth, variance]"});
  const Program program(arguments);
  REQUIRE(wait_until([&] { return fs::exists("out.exr"); }));
  const auto input = OIIO::ImageInput::open("out.exr");
  REQUIRE(input);
  CHECK(input->spec().nchannels == 3 + 3 + 3 + 1 + 3);
}

TEST_CASE("Option --write-every does not change the picture") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Words arguments{"scene.yaml", "--spp", "50", "--width", "64", "--quiet"};
  Words plain = arguments;
  plain.insert(plain.end(), {"-o", "plain.exr"});
  REQUIRE(run(plain).exit_code == 0);
  for (const char* seconds : {"0", "0.001", "1000"}) {
    Words early = arguments;
    early.insert(early.end(), {"-o", "early.exr", "--write-every", seconds});
    REQUIRE(run(early).exit_code == 0);
    CHECK(pah::read_image("early.exr").pixels == pah::read_image("plain.exr").pixels);
    CHECK(samples_in("early.exr") == 50);
  }
}

TEST_CASE(
    "A picture that cannot be written in the midst is warned of once, and the render goes on") {
  const CurrentTemporaryFolder folder;
  fs::create_directory("pictures");
  Words arguments = endless("pictures/out.exr");
  std::erase(arguments, "--quiet");
  Program program(arguments, ErrorStream::terminal);
  REQUIRE(wait_until([&] { return fs::exists("pictures/out.exr"); }));
  fs::rename("pictures", "elsewhere");
  REQUIRE(program.wait_for_error_text("warning: cannot write pictures/out.exr: "));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // more writes fail
  SECTION("if it can be written at the end, all is well") {
    fs::rename("elsewhere", "pictures");
    program.signal(SIGINT);
    const Outcome outcome = program.wait();
    CHECK(outcome.err.find("warning") == outcome.err.rfind("warning"));
    CHECK(outcome.err.find("wrote pictures/out.exr") != std::string::npos);
    CHECK(outcome.exit_code == 130);
  }
  SECTION("if not, that is an error") {
    program.signal(SIGINT);
    const Outcome outcome = program.wait();
    CHECK(outcome.err.find("pahrender: cannot write pictures/out.exr: ") != std::string::npos);
    CHECK(outcome.exit_code == 4);
  }
}

TEST_CASE("A pipe gets the finished picture only") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  REQUIRE(::mkfifo("out.png", 0600) == 0);
  std::string bytes;
  std::thread reader([&] { bytes = read_file("out.png"); });
  const Outcome outcome =
      run({"scene.yaml", "-o", "out.png", "--spp", "2000", "--quiet", "--write-every", "0"});
  reader.join();
  CHECK(outcome.exit_code == 0);
  CHECK(fs::is_fifo("out.png"));
  const std::string ends("IEND");
  CHECK(bytes.find(ends) == bytes.size() - ends.size() - 4);  // followed by a checksum
}
