// Warnings are printed and counted, and are errors with --strict.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;

namespace {

// A floor under a lamp at a height of 2.
std::string lit_floor(const std::string& lamp, const std::string& settings = "") {
  return "film: {width: 16, height: 16}\nrender: {samples: 4, max_depth: 1}\n"
         "camera: {position: [0, 3, 0], look_at: [0, 0, 0], up: [0, 0, 1], fov: 30}\n"
         "meshes: [{shape: rectangle, size: [9, 9]}]\n"
         "lights: [{name: bulb, position: [0, 2, 0], " +
         lamp + "}]\n" + settings;
}

const std::string bulb = "type: point, intensity: 1";

int warnings_in(const char* file) {
  return nlohmann::json::parse(read_file(file))["warnings"].get<int>();
}

}  // namespace

TEST_CASE("Warnings are counted, and are errors with --strict") {
  const CurrentTemporaryFolder folder;
  write_file("dark.yaml", "film: {width: 4, height: 4}\nmeshes: [{shape: box}]\n");
  const Outcome lenient = run({"dark.yaml", "-o", "a.exr", "--stats", "a.json"});
  CHECK(lenient.exit_code == 0);
  CHECK(contains(lenient.err, "warning: the scene has no light"));
  CHECK(warnings_in("a.json") == 1);

  for (const Words& options : {Words{}, Words{"--quiet"}, Words{"--check"}}) {
    Words words{"dark.yaml", "-o", "b.exr", "--strict"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome strict = run(words);
    CHECK(strict.exit_code == 3);
    CHECK(contains(strict.err, "error: the scene has no light"));
    CHECK(!contains(strict.err, "no errors"));
    CHECK(!fs::exists("b.exr"));
  }
}

TEST_CASE("Without warnings --strict changes nothing") {
  const CurrentTemporaryFolder folder;
  write_file("lit.yaml", lit_floor(bulb));
  const Outcome strict = run({"lit.yaml", "-o", "a.png", "--strict", "--stats", "a.json"});
  CHECK(strict.exit_code == 0);
  CHECK(!contains(strict.err, "warning"));
  CHECK(warnings_in("a.json") == 0);
}

TEST_CASE("A picture that is too bright for its format says which exposure would fit") {
  const CurrentTemporaryFolder folder;
  write_file("bright.yaml", lit_floor("type: point, intensity: 100"));
  const Outcome bright = run({"bright.yaml", "-o", "a.png"});
  CHECK(bright.exit_code == 0);
  const std::string fault = " % of the pixels are too bright for a.png; --exposure -";
  REQUIRE(contains(bright.err, fault));
  const std::string stops = bright.err.substr(bright.err.find(fault) + fault.size() - 1, 4);
  CHECK(!contains(run({"bright.yaml", "-o", "a.png", "--exposure", stops}).err, "too bright"));
  CHECK(!contains(run({"bright.yaml", "-o", "a.exr"}).err, "too bright"));

  const Outcome strict = run({"bright.yaml", "-o", "b.png", "--strict", "--quiet"});
  CHECK(strict.exit_code == 3);
  CHECK(contains(strict.err, "error: "));
  CHECK(fs::exists("b.png"));  // the warning comes after the render
}

TEST_CASE("Useless declared influence areas cause warnings") {
  const CurrentTemporaryFolder folder;
  const auto error_of = [](const std::string& light, const std::string& area) {
    write_file("area.yaml", lit_floor(light, "influence_areas: [" + area + "]\n"));
    return run({"area.yaml", "-o", "a.exr"}).err;
  };
  const std::string spot = "type: spot, direction: [0, -1, 0], angle: 30";
  const auto point = [](const std::string& forward, double far) {
    return "{type: point, light: bulb, forward: " + forward +
           ", fov: [60, 60], near: 0.1, far: " + std::to_string(far) + "}";
  };
  const std::string down = "[0, -1, 0]";
  const std::string aside = "[1, 0, 0]";
  CHECK(contains(error_of(bulb, point(down, 1)), "warning: influence area 'bulb' meets no mesh"));
  CHECK(contains(error_of(spot, point(aside, 9)),
                 "warning: influence area 'bulb' lies where its light sends no rays"));
  CHECK(!contains(error_of(spot, point(down, 9)), "warning"));
  CHECK(!contains(error_of(bulb, point(down, 9)), "warning"));
}
