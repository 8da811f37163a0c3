#include <algorithm>
#include <nlohmann/json.hpp>
#include <pah/io/image_file.hpp>
#include <sstream>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::testing;
using pah::CurrentTemporaryFolder;

TEST_CASE("inspect reports, and writes what it is asked for") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome =
      run({"inspect", "scene.yaml", "--width", "40", "-D", "film.width=64", "--json", "r.json",
           "--csv", "r.csv", "--heatmap", "heat.png", "--boxes", "boxes.gltf", "--levels", "2"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (const char* part : {"14 triangles", "expected cost", "camera rays", "heat.png"})
    CHECK(outcome.out.find(part) != std::string::npos);
  CHECK(files() ==
        std::vector<std::string>{"boxes.gltf", "heat.png", "r.csv", "r.json", "scene.yaml"});

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

  std::istringstream csv(read_file("r.csv"));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "bvh,quantity,at,value");
  bool found = false;
  while (std::getline(csv, line)) {
    CHECK(std::count(line.begin(), line.end(), ',') == 3);
    found = found || line == "global,triangles,,14";
  }
  CHECK(found);

  const pah::Image heat = pah::read_image("heat.png");
  CHECK(heat.width == 2 * 40);
  CHECK(heat.height == 15);
  CHECK(nlohmann::json::parse(read_file("boxes.gltf"))["meshes"].size() == 2);
}

TEST_CASE("inspect tells of the local BVHs that a render has") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", std::string(small_scene) +
                               "influence_areas:\n"
                               "  - {type: point, light: bulb, forward: [0, -1, 0],"
                               " fov: [120, 120], near: 0, far: 4}\n"
                               "acceleration: {heuristic: pah}\n");
  const Outcome outcome = run({"inspect", "scene.yaml", "--json", "r.json", "--csv", "r.csv"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto report = nlohmann::json::parse(read_file("r.json"));
  REQUIRE(report["bvhs"].size() == 2);
  const auto& bvh = report["bvhs"][1];
  CHECK(bvh["heuristic"] == "projected area");
  CHECK(bvh["triangles"] == 14);
  CHECK(bvh["bundle_cost"]["local"].get<double>() > 0);
  CHECK(bvh["bundle_cost"]["local"].get<double>() <= bvh["bundle_cost"]["global"].get<double>());
  CHECK_FALSE(bvh.contains("camera_rays"));
  CHECK(outcome.out.find("BVH bulb") != std::string::npos);
  CHECK(read_file("r.csv").find("bundle_cost,global,") != std::string::npos);
}

TEST_CASE("inspect takes scenes of nothing") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", "film: {width: 8, height: 6}\n");
  const Outcome outcome =
      run({"inspect", "scene.yaml", "--heatmap", "heat.png", "--boxes", "boxes.gltf"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("0 triangles") != std::string::npos);
}

TEST_CASE("inspect ends as it should where it cannot") {
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
      {{"inspect", "scene.yaml", "--boxes", "boxes.obj"}, 2},
      {{"--spp", "4", "inspect", "scene.yaml"}, 2},
      {{"inspect", "bad.yaml"}, 3},
      {{"inspect", "scene.yaml", "-D", "film.widht=3"}, 3},
      {{"inspect", "missing.yaml"}, 4},
      {{"inspect", "scene.yaml", "--json", "missing/r.json"}, 4},
      {{"inspect", "scene.yaml", "--csv", "missing/r.csv"}, 4},
      {{"inspect", "scene.yaml", "--heatmap", "missing/heat.png"}, 4},
      {{"inspect", "scene.yaml", "--boxes", "missing/boxes.gltf"}, 4},
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
