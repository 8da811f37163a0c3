// Renders of small scenes, end to end.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <pah/geometry/vec.hpp>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using Words = std::vector<std::string>;
using nlohmann::json;

namespace {

// Renders with --quiet and checks that nothing is printed.
void render(Words arguments) {
  arguments.emplace_back("--quiet");
  const Outcome outcome = run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
}

json read_json(const std::string& name) { return json::parse(read_file(name)); }

// Compares pixels bit by bit: EXR files hold the film's floats without rounding.
bool identical(const std::string& a, const std::string& b) {
  const pah::Image image = pah::read_image(a);
  const pah::Image other = pah::read_image(b);
  return image.width == other.width && image.height == other.height && image.pixels == other.pixels;
}

bool is_black(const std::string& file) {
  const pah::Image image = pah::read_image(file);
  return std::ranges::all_of(image.pixels, [](const pah::Vec3& p) { return p == pah::Vec3(0); });
}

}  // namespace

TEST_CASE("A render writes its picture, says so, and leaves stdout alone") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "-o", "out.exr"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("wrote out.exr: 32 x 24, 4 samples, "));
  CHECK(outcome.err.find("4 samples") != std::string::npos);
  CHECK(outcome.err.find("rays/s") != std::string::npos);
  CHECK(std::ranges::count(outcome.err, '\n') == 1);
  CHECK(files() == Words{"out.exr", "scene.yaml"});
  const pah::Image image = pah::read_image("out.exr");
  CHECK(image.width == 32);
  CHECK(image.height == 24);
  CHECK(!is_black("out.exr"));
}

TEST_CASE("Without -o the picture is named like the scene, in the current folder") {
  const CurrentTemporaryFolder folder;
  fs::create_directory("scenes");
  write_file("scenes/small.yaml", small_scene);
  render({"scenes/small.yaml"});
  CHECK(files() == Words{"scenes", "small.png"});
}

TEST_CASE("Every picture format can be written") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  for (const std::string& extension : pah::image_extensions()) {
    CAPTURE(extension);
    render({"scene.yaml", "-o", "out" + extension});
    CHECK(pah::read_image("out" + extension).width == 32);
  }
}

TEST_CASE("The command line overrides the scene") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.exr", "--stats", "stats.json", "--spp", "3", "--width", "20",
          "--height", "10", "--seed", "18446744073709551615", "--threads", "2"});
  const json stats = read_json("stats.json");
  CHECK(stats["samples"] == 3);
  CHECK(stats["width"] == 20);
  CHECK(stats["height"] == 10);
  CHECK(stats["seed"] == 18446744073709551615U);
  CHECK(stats["threads"] == 2);
  CHECK(pah::read_image("out.exr").width == 20);

  render({"-D", "film.width=21", "-D", "render.samples=2", "scene.yaml", "-o", "out.exr", "--stats",
          "stats.json"});
  CHECK(read_json("stats.json")["width"] == 21);
  CHECK(read_json("stats.json")["samples"] == 2);
}

TEST_CASE("Option --width or --height alone keeps the aspect ratio of the scene") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);  // 32 x 24
  const auto size = [](const char* option, const char* value) {
    render({"scene.yaml", "-o", "out.exr", option, value, "--spp", "1"});
    const pah::Image image = pah::read_image("out.exr");
    return std::pair(image.width, image.height);
  };
  CHECK(size("--width", "64") == std::pair(64, 48));
  CHECK(size("--height", "6") == std::pair(8, 6));
  CHECK(size("--width", "15") == std::pair(15, 11));
  CHECK(size("--height", "1") == std::pair(1, 1));
}

TEST_CASE("Option --exposure counts in stops, in low dynamic range files only") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.png"});
  CHECK(!is_black("out.png"));
  render({"scene.yaml", "-o", "out.png", "--exposure", "-20"});
  CHECK(is_black("out.png"));
  render({"scene.yaml", "-o", "a.exr"});
  render({"scene.yaml", "-o", "b.exr", "--exposure", "-20"});
  CHECK(identical("a.exr", "b.exr"));
}

TEST_CASE("Option --stats writes every key of the contract, of the right type") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.png", "--stats", "stats.json"});
  const json stats = read_json("stats.json");
  const auto at = [&](const char* key) { return stats.value(json::json_pointer(key), json()); };
  for (const char* key : {"/version", "/scene", "/accelerator"}) {
    CAPTURE(key);
    CHECK(at(key).is_string());
  }
  for (const char* key :
       {"/width", "/height", "/samples", "/threads", "/seed", "/triangles", "/rays/camera",
        "/rays/shadow", "/rays/bounce", "/memory_bytes/scene", "/memory_bytes/global_bvh",
        "/memory_bytes/local_bvhs", "/memory_bytes/top_level", "/memory_bytes/film",
        "/peak_memory_bytes", "/nan_samples", "/warnings"}) {
    CAPTURE(key);
    CHECK(at(key).is_number_unsigned());
  }
  for (const char* key :
       {"/seconds/load", "/seconds/build", "/seconds/render", "/seconds/total",
        "/traversal/nodes_per_ray/camera", "/traversal/nodes_per_ray/shadow",
        "/traversal/nodes_per_ray/bounce", "/traversal/triangles_per_ray/camera",
        "/traversal/triangles_per_ray/shadow", "/traversal/triangles_per_ray/bounce", "/error/mse",
        "/error/relmse", "/mean_samples", "/error/confidence95/0", "/error/confidence95/1"}) {
    CAPTURE(key);
    CHECK(at(key).is_number_float());
  }
  CHECK(at("/influence_areas").is_array());

  CHECK(at("/scene") == "scene.yaml");
  CHECK(at("/accelerator") == "bvh");
  CHECK(at("/triangles") == 14);
  CHECK(at("/rays/camera") == 32 * 24 * 4);
  CHECK(at("/rays/shadow") > 0);
  CHECK(at("/traversal/triangles_per_ray/camera") > 0);
  CHECK(at("/memory_bytes/global_bvh") > 0);
  CHECK(at("/nan_samples") == 0);
  CHECK(at("/mean_samples") == 4);
  CHECK(at("/error/confidence95/0") <= at("/error/relmse"));
  CHECK(at("/error/relmse") <= at("/error/confidence95/1"));
  CHECK(at("/seconds/render") <= at("/seconds/total"));
}

TEST_CASE("EXR files say how they were made and hold the layers asked for") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.exr", "-D", "film.channels=[albedo, depth]"});
  const auto file = OIIO::ImageInput::open("out.exr");
  REQUIRE(file);
  const OIIO::ImageSpec& spec = file->spec();
  CHECK(spec.get_string_attribute("pahrender:samples") == "4");
  CHECK(spec.get_string_attribute("pahrender:seed") == "3");
  CHECK(!spec.get_string_attribute("pahrender:version").empty());
  CHECK(!spec.get_string_attribute("pahrender:scene_hash").empty());
  CHECK(!spec.get_string_attribute("pahrender:seconds").empty());
  CHECK(spec.channelindex("albedo.R") >= 0);
  CHECK(spec.channelindex("depth.Z") >= 0);
  CHECK(spec.channelindex("normal.X") < 0);
  CHECK(spec.channelformat(0) == OIIO::TypeFloat);

  render({"scene.yaml", "-o", "half.exr", "--half"});
  CHECK(OIIO::ImageInput::open("half.exr")->spec().channelformat(0) == OIIO::TypeHalf);
}

TEST_CASE("A film keeps features only if a layer asks for them") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const auto film_bytes = [](const char* output, const char* channels) {
    render({"scene.yaml", "-o", output, "-D", std::string("film.channels=") + channels, "--stats",
            "stats.json"});
    return read_json("stats.json")["memory_bytes"]["film"].get<int>();
  };
  constexpr int pixels = 32 * 24;
  CHECK(film_bytes("plain.exr", "[]") == 80 * pixels);
  CHECK(film_bytes("variance.exr", "[variance]") == 80 * pixels);
  CHECK(film_bytes("layers.exr", "[albedo, normal, depth, variance]") == 136 * pixels);
  CHECK(film_bytes("layers.png", "[albedo, normal, depth, variance]") == 80 * pixels);
  CHECK(identical("plain.exr", "layers.exr"));
}

TEST_CASE("PNG files have 16 bits with --png-bits, and no room for layers, which is said") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.PNG", "--png-bits", "16"});
  CHECK(OIIO::ImageInput::open("out.PNG")->spec().format == OIIO::TypeUInt16);
  const Outcome outcome = run({"scene.yaml", "-o", "out.png", "-D", "film.channels=[depth]"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.starts_with("warning: out.png cannot hold the 'channels' of film"));
}

TEST_CASE("TIFF files are linear, as EXR files are") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "out.exr"});
  render({"scene.yaml", "-o", "out.tif", "--exposure", "-20"});
  CHECK(identical("out.exr", "out.tif"));
}

TEST_CASE("Option --time-limit ends an endless render") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "-o", "out.png", "--spp", "1000000000", "--time-limit",
                               "0.2", "--stats", "stats.json"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find(" of 1000000000 samples") != std::string::npos);
  CHECK(fs::exists("out.png"));
  CHECK(read_json("stats.json")["samples"] >= 1);
}

TEST_CASE("A crop is that part of the whole picture") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "whole.exr"});
  render({"scene.yaml", "-o", "crop.exr", "--crop", "5,21,3,20"});
  const pah::Image whole = pah::read_image("whole.exr");
  const pah::Image crop = pah::read_image("crop.exr");
  REQUIRE(crop.width == 16);
  REQUIRE(crop.height == 17);
  bool same = true;
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x) same = same && crop.at(x, y) == whole.at(x + 5, y + 3);
  CHECK(same);
}

TEST_CASE("Another seed gives another picture") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  render({"scene.yaml", "-o", "a.exr"});
  render({"scene.yaml", "-o", "b.exr", "--seed", "4"});
  CHECK(!identical("a.exr", "b.exr"));
}

TEST_CASE("Options --threads and --accel work and never change a pixel") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const auto render_to = [](const char* out, const char* accelerator, const char* threads) {
    render({"scene.yaml", "-o", out, "--accel", accelerator, "--threads", threads, "--stats",
            "stats.json"});
    const json stats = read_json("stats.json");
    CHECK(stats["accelerator"] == accelerator);
    CHECK(stats["threads"] == std::stoi(threads));
    return stats["traversal"]["triangles_per_ray"]["camera"].get<double>();
  };
  CHECK(render_to("reference.exr", "brute_force", "1") == 14);
  for (const char* accelerator : {"bvh", "local"})
    for (const char* threads : {"1", "2", "7"}) {
      CAPTURE(accelerator, threads);
      CHECK(render_to("out.exr", accelerator, threads) < 14);
      CHECK(identical("out.exr", "reference.exr"));
    }
}

TEST_CASE("A declared influence area is built and measured, and left out by --accel bvh and off") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", std::string(small_scene) +
                               "influence_areas: [auto, {type: point, light: bulb, fov: [120, 120],"
                               " far: 4}]\n"
                               "acceleration: {heuristic: pah, split_axis: facing}\n");
  const auto stats_of = [](const Words& options) {
    Words words{"scene.yaml", "-o", "out.exr", "--stats", "stats.json"};
    words.insert(words.end(), options.begin(), options.end());
    render(words);
    return read_json("stats.json");
  };
  const json local = stats_of({});
  fs::rename("out.exr", "local.exr");
  CHECK(local["accelerator"] == "local");
  CHECK(local["memory_bytes"]["local_bvhs"] > 0);
  CHECK(local["memory_bytes"]["top_level"] > 0);
  const json& areas = local["influence_areas"];
  REQUIRE(areas.size() == 7);  // the declared one, five sides of the bulb and the camera's
  const json& built = areas[0];
  CHECK(built["name"] == "bulb");
  CHECK(built["type"] == "point");
  CHECK(built["light"] == "bulb");
  CHECK(built["built"] == true);
  CHECK(built["reason"] == "declared");
  CHECK(built["triangles"] == 14);
  CHECK(built["rays"] > 0);
  CHECK(built["rays"] <= local["rays"]["shadow"]);
  CHECK(built["rays"] <= built["asked_rays"]);
  CHECK(built["sampled_rays"] > 0);
  CHECK(built["sampled_rays"] < built["asked_rays"]);
  for (const char* cost :
       {"predicted_cost", "measured_cost", "global_cost", "measured_global_cost"}) {
    CAPTURE(cost);
    CHECK(built[cost] > 0);
  }
  const json& left_out = areas[1];
  CHECK(left_out["name"] == "bulb -x");
  CHECK(left_out["built"] == false);
  CHECK(left_out["reason"].get<std::string>().find("not expected") != std::string::npos);
  for (const char* key : {"predicted_cost", "measured_cost", "global_cost", "measured_global_cost",
                          "rays", "asked_rays", "sampled_rays"}) {
    CAPTURE(key);
    REQUIRE(left_out.contains(key));
    CHECK(left_out[key].is_null());
  }

  const json bvh = stats_of({"--accel", "bvh"});
  CHECK(bvh["accelerator"] == "bvh");
  CHECK(bvh["memory_bytes"]["local_bvhs"] == 0);
  REQUIRE(bvh["influence_areas"].size() == 7);
  CHECK(bvh["influence_areas"][0]["built"] == false);
  CHECK(identical("out.exr", "local.exr"));

  const json off = stats_of({"-D", "influence_areas=off"});
  CHECK(off["accelerator"] == "bvh");
  CHECK(off["influence_areas"].empty());
  CHECK(identical("out.exr", "local.exr"));
}
