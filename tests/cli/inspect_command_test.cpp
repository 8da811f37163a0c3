#include <algorithm>
#include <nlohmann/json.hpp>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;

TEST_CASE("Inspect reports, and writes what it is asked for") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"inspect", "scene.yaml", "--width", "40", "-D", "film.width=64",
                               "--json", "r.json", "--heatmap", "heat.png", "--levels", "2",
                               "--structures", "structures.png", "--overlay", "overlay.png"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (const char* part : {"14 triangles", "expected cost", "camera rays", "heat.png",
                           "structures.png", "gray      global BVH", "overlay.png: 0 of "})
    CHECK(outcome.out.find(part) != std::string::npos);
  CHECK(files() == std::vector<std::string>{"heat.png", "overlay.png", "r.json", "scene.yaml",
                                            "structures.png"});

  const auto report = nlohmann::json::parse(read_file("r.json"));
  CHECK(report["scene"] == "scene.yaml");
  CHECK(report["triangles"] == 14);
  REQUIRE(report["bvhs"].size() == 1);
  const auto& bvh = report["bvhs"][0];
  CHECK(bvh["name"] == "global");
  CHECK(bvh["triangles"] == 14);
  CHECK(bvh["nodes"] == 2 * bvh["leaves"].get<int>() - 1);
  CHECK(bvh["expected_cost"].get<double>() > 0);
  CHECK(bvh["camera_rays"]["rays"] == 40 * 15);
  CHECK(bvh["camera_rays"]["hits"].get<int>() > 0);
  CHECK(bvh["camera_rays"]["nodes_per_ray"].get<double>() > 0);
  CHECK(bvh["memory_bytes"].get<int>() > 0);
  int triangles = 0, leaves = 0, nodes = 0;
  for (const auto& size : bvh["leaf_sizes"])
    triangles += size["triangles"].get<int>() * size["leaves"].get<int>();
  for (const auto& level : bvh["levels"]) {
    leaves += level["leaves"].get<int>();
    nodes += level["nodes"].get<int>();
  }
  CHECK(triangles == 14);
  CHECK(leaves == bvh["leaves"].get<int>());
  CHECK(nodes == bvh["nodes"].get<int>());
  CHECK(bvh["levels"].size() == bvh["depth"]["max"].get<std::size_t>() + 1);

  const pah::Image heat = pah::read_image("heat.png");
  CHECK(heat.width == 2 * 40);
  CHECK(heat.height == 15);
  CHECK(pah::read_image("structures.png").width == 40);
  CHECK(pah::read_image("overlay.png").width == 40);
}

TEST_CASE("Inspect reports the local BVHs of a render") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", std::string(small_scene) +
                               "influence_areas:\n"
                               "  - {type: point, light: bulb, forward: [0, -1, 0],"
                               " fov: [120, 120], near: 0, far: 4}\n"
                               "acceleration: {heuristic: pah}\n");
  const Outcome outcome = run({"inspect", "scene.yaml", "--json", "r.json"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto report = nlohmann::json::parse(read_file("r.json"));
  REQUIRE(report["bvhs"].size() == 2);
  const auto& bvh = report["bvhs"][1];
  CHECK(bvh["heuristic"] == "PAH");
  CHECK(bvh["triangles"] == 14);
  CHECK(bvh["bundle_cost"]["local"].get<double>() > 0);
  CHECK(bvh["bundle_cost"]["local"].get<double>() <= bvh["bundle_cost"]["global"].get<double>());
  CHECK_FALSE(bvh.contains("camera_rays"));
  CHECK(outcome.out.find("BVH bulb") != std::string::npos);
}

TEST_CASE("Inspect reports which lights have grids, and why") {
  const CurrentTemporaryFolder folder;
  const std::string ball =
      "camera: {position: [0, 1, 3], look_at: [0, 0, 0]}\n"
      "film: {width: 32, height: 24}\n"
      "meshes: [{shape: sphere, segments: 128, rings: 64}]\n"
      "lights: [{name: bulb, type: point, position: [1, 4, 1]}, {name: \"a, \\\"b\\\"\", type: "
      "directional, direction: [0, 1, 3]}, {name: sky, type: environment}]\n"
      "render: {max_depth: 1, samples: ";
  write_file("scene.yaml", ball + "64}\n");
  const Outcome outcome = run({"inspect", "scene.yaml", "--json", "r.json"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto report = nlohmann::json::parse(read_file("r.json"));
  CHECK(report["accelerator"] == "bvh");
  REQUIRE(report["light_grids"].size() == 2);
  const auto& bulb = report["light_grids"][0];
  CHECK(bulb["light"] == "bulb");
  CHECK(bulb["built"] == false);
  CHECK(bulb["expected_rays"].get<double>() > 0);
  CHECK(bulb["expected_rays"].get<double>() < 32 * 24 * 64 / 3.0);
  CHECK(bulb["pilot_rays"].get<int>() > 0);
  CHECK(bulb["occluded_share"].get<double>() <= 1);
  CHECK(bulb["bvh_seconds_per_ray"].get<double>() > 0);
  CHECK(bulb["predicted_seconds_per_ray"].get<double>() > 0);
  CHECK(bulb["build_seconds"].is_null());
  const auto& below = report["light_grids"][1];
  CHECK(below["light"] == "a, \"b\"");
  CHECK(below["reason"] == "none of the pilot's rays goes to it");
  CHECK(below["pilot_rays"] == 0);
  for (const char* part : {"accelerator of a render: bvh", "Grid of light bulb: not built",
                           "none of the pilot's rays goes to it", "per ray, BVH"})
    CHECK(contains(outcome.out, part));

  const auto reason_with = [](const std::string& key) {
    REQUIRE(run({"inspect", "scene.yaml", "-D", "render.samples=1000000", "-D", key, "--json",
                 "r.json"})
                .exit_code == 0);
    return nlohmann::json::parse(read_file("r.json"))["light_grids"][0]["reason"];
  };
  CHECK(reason_with("influence_areas=off") == "the scene asks for no derived areas");
  CHECK(reason_with("acceleration.memory=1 MB") ==
        "it would take more memory than the scene allows");
  CHECK(contains(run({"inspect", "scene.yaml", "-D", "acceleration.memory=1 kB"}).err,
                 "warning: the BVH of the whole scene takes"));
}

TEST_CASE("Inspect accepts empty scenes") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", "film: {width: 8, height: 6}\n");
  const Outcome outcome =
      run({"inspect", "scene.yaml", "--heatmap", "heat.png", "--overlay", "overlay.png"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("0 triangles") != std::string::npos);
}

TEST_CASE("Inspect reports wrong usage, scene errors and missing files") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  write_file("bad.yaml", "film: {width: 0}\n");
  using Words = std::vector<std::string>;
  const std::vector<std::pair<Words, int>> cases{
      {{"inspect"}, 2},
      {{"inspect", "scene.yaml", "--nope"}, 2},
      {{"inspect", "scene.yaml", "--levels", "0"}, 2},
      {{"inspect", "scene.yaml", "--width", "0"}, 2},
      {{"inspect", "scene.yaml", "--width", "65536", "--height", "65536"}, 2},
      {{"inspect", "scene.yaml", "--heatmap", "heat.exr"}, 2},
      {{"inspect", "scene.yaml", "--boxes", "boxes.gltf"}, 2},
      {{"inspect", "scene.yaml", "--structures", "structures.exr"}, 2},
      {{"inspect", "scene.yaml", "--overlay", "overlay.exr"}, 2},
      {{"--spp", "4", "inspect", "scene.yaml"}, 2},
      {{"inspect", "bad.yaml"}, 3},
      {{"inspect", "scene.yaml", "-D", "film.widht=3"}, 3},
      {{"inspect", "missing.yaml"}, 4},
      {{"inspect", "scene.yaml", "--json", "missing/r.json"}, 4},
      {{"inspect", "scene.yaml", "--heatmap", "missing/heat.png"}, 4},
      {{"inspect", "scene.yaml", "--structures", "missing/structures.png"}, 4},
  };
  const Words before = files();
  for (const auto& [arguments, exit_code] : cases) {
    const Outcome outcome = run(arguments);
    INFO(outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.out.empty());
    CHECK_FALSE(outcome.err.empty());
    CHECK(files() == before);
  }
}

TEST_CASE("Inspect reports derived areas on request") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"inspect", "scene.yaml", "--all-areas", "--json", "r.json"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto bvhs = nlohmann::json::parse(read_file("r.json"))["bvhs"];
  REQUIRE(bvhs.size() > 1);
  CHECK(bvhs[0]["surface_cost"] == bvhs[0]["expected_cost"]);
  CHECK_FALSE(bvhs[0].contains("seen_overlap"));
  for (std::size_t i = 1; i < bvhs.size(); ++i) {
    CHECK(bvhs[i]["seen_overlap"].get<double>() >= 0);
    CHECK(bvhs[i]["seen_overlap"].get<double>() <= 1);
    if (bvhs[i]["triangles"] == 0) continue;  // nothing beside the bulb
    CHECK(bvhs[i]["levels"][0].contains("seen_overlap"));
    CHECK(bvhs[i]["surface_cost"].get<double>() > 0);
  }
  CHECK(contains(outcome.out, "as the rays see it"));
}

TEST_CASE("Inspect names what replaced its former outputs") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  CHECK(contains(run({"inspect", "scene.yaml", "--csv", "r.csv"}).err, "with --json"));
  CHECK(contains(run({"inspect", "scene.yaml", "--boxes", "b.gltf"}).err, "with --overlay"));
}
