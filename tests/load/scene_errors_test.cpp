// Files that are not scenes, and the format of errors: place, excerpt and limits.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <pah/load/load_scene.hpp>

#include "catch.hpp"
#include "scene_faults.hpp"
#include "support/mutate.hpp"
#include "support/paths.hpp"

using namespace pah;

TEST_CASE("An error has place, suggestion, excerpt and caret") {
  const TemporaryFolder folder;
  const auto file = write_text(folder / "scene.yaml",
                               "materials:\n"
                               "  white:\n"
                               "    type: diffuse\n"
                               "    reflectence: [0.8, 0.8, 0.8]\n");
  try {
    (void)load_scene(file);
    FAIL("no error");
  } catch (const SceneError& error) {
    REQUIRE(error.errors().size() == 1);
    CHECK(format_error(error.errors()[0]) ==
          file.string() +
              ":4:5: error: unknown key 'reflectence' in material 'white'; did you mean "
              "'reflectance'?\n"
              "      reflectence: [0.8, 0.8, 0.8]\n"
              "      ^");
  }
}

TEST_CASE("Columns count characters, and the caret stands under the place") {
  const TemporaryFolder folder;
  const auto file = write_text(folder / "scene.yaml", "film: {\"h\xC3\xB6he\":\t3, x: 1}\n");
  try {
    (void)load_scene(file);
    FAIL("no error");
  } catch (const SceneError& error) {
    REQUIRE(error.errors().size() == 2);
    CHECK(error.errors()[1].where.column == 19);
    CHECK(format_error(error.errors()[1]).ends_with("\n                \t   ^"));
  }
}

TEST_CASE("A long line is shown in part") {
  const std::string text = "x-a: [" + std::string(3000, '1') + "]\nfilm: {width: [" +
                           std::string(3000, '2') + "], x: 1, " + std::string(3000, ' ') + "}\n";
  const TemporaryFolder folder;
  try {
    (void)load_scene(write_text(folder / "scene.yaml", text));
    FAIL("no error");
  } catch (const SceneError& error) {
    const LocatedError& last = error.errors().back();
    CHECK(last.where.column == 3019);
    CHECK(last.excerpt.size() == 160);
    CHECK(last.excerpt[static_cast<std::size_t>(last.caret - 1)] == 'x');
  }
}

TEST_CASE("All errors are reported at once, in order") {
  CHECK(errors_of("lights:\n"
                  "  - {name: sun, type: directional, irradiance: much}\n"
                  "film: {width: 0}\n"
                  "render: {samples: -3, sed: 1}\n") ==
        "scene.yaml:2:48: error: 'irradiance' of light 'sun' must be a color ([r, g, b], a number "
        "or \"#rrggbb\"), not 'much'\n"
        "scene.yaml:3:15: error: 'width' of film must be a whole number between 1 and 65536, not "
        "0\n"
        "scene.yaml:4:19: error: 'samples' of render must be a whole number between 1 and "
        "1073741824, not -3\n"
        "scene.yaml:4:23: error: unknown key 'sed' in render; did you mean 'seed'?\n");
}

TEST_CASE("Beyond a hundred errors only their number is reported") {
  std::string text = "film:\n";
  for (int i = 0; i < 250; ++i) text += "  zzzzzzz" + std::to_string(i) + ": 1\n";
  const std::string errors = errors_of(text);
  CHECK(std::count(errors.begin(), errors.end(), '\n') == 101);
  CHECK(errors.ends_with("scene.yaml: error: and 150 more errors\n"));
}

TEST_CASE("Bad YAML is a located error") {
  check_all({
      {"", "scene.yaml: error: the file holds no scene"},
      {"# nothing\n", "scene.yaml: error: the file holds no scene"},
      {"3\n", "scene.yaml:1:1: error: the scene must be a map, not 3"},
      {"a: b: c\n", "scene.yaml:1:5: error: not valid YAML: illegal map value"},
      {"film: {width: 3\nrender: }\n",
       "scene.yaml:2:7: error: not valid YAML: end of map flow not found"},
      {"x-a: \"abc\n", "scene.yaml:1:10: error: a quoted text does not end"},
      {"x-a: \"abc\nfilm: {}\n", "scene.yaml:2:9: error: a quoted text does not end"},
      {"film: {width: [1, 2\n", "scene.yaml:1:15: error: the '[' here is not closed"},
      {"x-a: *nobody\n",
       "scene.yaml:1:6: error: not valid YAML: the referenced anchor is not defined"},
      {"film: {width: 3}\n---\nfilm: {}\n",
       "scene.yaml:2:1: error: only one YAML document is allowed in a file"},
      {"film: {width: 3}\nfilm: {width: 4}\n",
       "scene.yaml:2:1: error: duplicate key 'film'; the first is on line 1"},
      {"film: {[1]: 3}\n",
       "scene.yaml:1:8: error: a key must be text, not a list or map; is a bracket left open?"},
      {"x-a: !thing 3\n",
       "scene.yaml:1:6: error: tags such as '!thing' are not part of the language"},
      {"film: {<<: 3}\n", "scene.yaml:1:8: error: '<<' takes a map or a list of maps"},
  });
}

TEST_CASE("Bytes that are not text are refused") {
  CHECK(errors_of(std::string_view("film:\n  a\0b", 11)) ==
        "scene.yaml:2:4: error: not a text file: it holds the byte 0x00\n");
  CHECK(errors_of("a: \x04\n") ==
        "scene.yaml:1:4: error: not a text file: it holds the byte 0x04\n");
  CHECK(errors_of("a: \xFF\xFE\n") == "scene.yaml:1:4: error: not a text file: it is not UTF-8\n");
  CHECK(errors_of("a: \xED\xA0\x80\n") ==
        "scene.yaml:1:4: error: not a text file: it is not UTF-8\n");
}

TEST_CASE("A byte order mark and Windows line ends are no errors") {
  CHECK(errors_of("\xEF\xBB\xBF"
                  "film: {width: 3}\r\nrender: {samples: x}\r\n") ==
        "scene.yaml:2:19: error: 'samples' of render must be a whole number, not 'x'\n");
}

TEST_CASE("Aliases that contain themselves or grow without limit are refused") {
  check_all({{"x-a: &a\n  - [1, *a]\n",
              "scene.yaml:2:9: error: this alias refers to a value that contains it"},
             {"x-a: &a {b: *a}\n",
              "scene.yaml:1:13: error: this alias refers to a value that contains it"}});
  std::string bomb = "x-0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    bomb += "x-" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
    for (int k = 1; k < 10; ++k) bomb += ", " + alias;
    bomb += "]\n";
  }
  CHECK(errors_of(bomb) ==
        "scene.yaml:7:26: error: more than 4000000 values, aliases counted wherever they are "
        "used\n");
  // Aliases add to the depth too.
  std::string deep = "x-0: &a0 [[[[[[[[1]]]]]]]]\n";
  for (int i = 1; i < 20; ++i)
    deep += "x-" + std::to_string(i) + ": &a" + std::to_string(i) + " [[[[*a" +
            std::to_string(i - 1) + "]]]]\n";
  CHECK(errors_of(deep) == "scene.yaml:15:16: error: nested more than 64 levels deep\n");
}

TEST_CASE("Merge keys that grow without limit are refused") {
  std::string text = "x-a: &a {";
  for (int i = 0; i < 1000; ++i) text += "k" + std::to_string(i) + ": 1, ";
  text += "}\nx-b: {<<: [*a";
  for (int i = 0; i < 4000; ++i) text += ", *a";
  text += "]}\n";
  LoadOptions options;
  options.limits.yaml_nodes = 8'000'000;
  CHECK(errors_of(text) ==
        "scene.yaml:2:15996: error: more than 4000000 values, aliases counted wherever they are "
        "used\n");
  options.limits.yaml_nodes = 3'000'000;
  CHECK(errors_of(text, options).find("more than 3000000") != std::string::npos);
}

TEST_CASE("Deep nesting does not overflow the stack") {
  CHECK(errors_of(std::string(1'000'000, '[')) ==
        "scene.yaml:1:4097: error: too many open brackets\n");
  std::string dashes;
  for (int i = 0; i < 1'000'000; ++i) dashes += "- ";
  CHECK(errors_of(dashes) == "scene.yaml:1:129: error: nested more than 64 levels deep\n");
  CHECK(errors_of("x-a: " + std::string(70, '[') + std::string(70, ']')) ==
        "scene.yaml:1:69: error: nested more than 64 levels deep\n");
  CHECK(errors_of("x-a: " + std::string(63, '[') + std::string(63, ']')).empty());
}

TEST_CASE("A file that is not a scene is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(load_scene(folder.path()),
                    "cannot read '" + folder.path().string() + "': it is a directory");
  CHECK_THROWS_AS(load_scene(folder / "nothing.yaml"), FileError);
  LoadOptions options;
  options.limits.scene_bytes = 10;
  CHECK(errors_of("film: {width: 3}\n", options) ==
        "scene.yaml: error: larger than the limit of 10 bytes\n");
}

TEST_CASE("Mutated scenes load or are refused with a place") {
  const TemporaryFolder folder;
  std::filesystem::copy(test::source_folder() / "scenes", folder.path(),
                        std::filesystem::copy_options::recursive);
  std::vector<std::string> seeds;
  for (const char* name :
       {"cornell_box", "textured", "glass_and_metal", "soft_shadow", "thin_lens"}) {
    std::ifstream stream(folder / (std::string(name) + ".yaml"));
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    REQUIRE(seeds.back().size() > 100);
  }
  LoadOptions options;
  options.limits.triangles = 200'000;
  options.limits.instances = 10'000;
  std::mt19937 random(1);
  int loaded = 0;
  for (int i = 0; i < 1500; ++i) {
    const std::string text =
        mutated(seeds[i % seeds.size()], random, "0123456789-.: ,[]{}#&*\"'\n");
    CAPTURE(text);
    try {
      (void)load_scene(write_text(folder / "scene.yaml", text), options);
      ++loaded;
    } catch (const SceneError& error) {
      for (const LocatedError& one : error.errors()) {
        CAPTURE(one.message);
        REQUIRE(one.where.line > 0);
      }
    }
  }
  CHECK(loaded > 20);
}
