#include "meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <pah/load/mesh_file.hpp>
#include <pah/scene/areas.hpp>
#include <pah/scene/placement.hpp>
#include <pah/scene/shapes.hpp>

#include "generated_scenes.hpp"
#include "report/study/stage.hpp"

namespace pah::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* shapes = "shapes";
// Two dense surfaces, and a building of large and small triangles.
constexpr std::array<const char*, 4> mesh_files{"nefertiti", "stanford-bunny", "CottageWalls",
                                                "WoodScene"};

fs::path mesh_folder() {
  const char* named = std::getenv("PAHRENDER_MESHES");
  return named != nullptr ? fs::path(named) : fs::path(PAH_SOURCE_DIR) / "../shared/meshes";
}

fs::path file_of(const std::string& mesh) { return mesh_folder() / (mesh + ".obj"); }

// Spheres and tori in the air, 63,360 triangles.
void add_shapes(Scene& scene) {
  const auto first = static_cast<MeshId>(scene.meshes.size());
  scene.meshes.push_back(make_mesh(SphereShape{0.14, 48, 24}));
  scene.meshes.push_back(make_mesh(TorusShape{0.16, 0.06, 64, 24}));
  ScatterOptions options;
  options.count = 24;
  options.seed = 1;
  const std::vector<glm::dmat4x3> places = scatter({1.7, 1.7}, options);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Instance instance;
    instance.mesh = first + static_cast<MeshId>(i % 2);
    instance.world_from_object = places[i];
    instance.world_from_object[3].y += 0.15 + 0.07 * static_cast<double>(i);
    scene.instances.push_back(instance);
  }
}

// Hills about a meter high, 708 x 708 quads.
void add_terrain(Scene& scene) {
  constexpr std::uint32_t quads = 708, row = quads + 1;
  Mesh mesh;
  for (std::uint32_t i = 0; i < row * row; ++i) {
    const float x = 2 * static_cast<float>(i % row) / quads - 1;
    const float z = 2 * static_cast<float>(i / row) / quads - 1;
    float height = 0;
    float scale = 0.25F;
    for (float frequency = 2; frequency < 200; frequency *= 2.3F, scale *= 0.45F)
      height += scale * std::sin(frequency * x + height) * std::cos(1.3F * frequency * z - height);
    mesh.positions.emplace_back(x, 0.5F + height, z);
  }
  for (std::uint32_t i = 0; i < quads * quads; ++i) {
    const std::uint32_t a = i / quads * row + i % quads;
    mesh.triangles.emplace_back(a, a + row, a + 1);
    mesh.triangles.emplace_back(a + 1, a + row, a + row + 1);
  }
  scene.instances.emplace_back().mesh = static_cast<MeshId>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
}

Scene scene_with(const std::string& mesh) {
  Scene scene = make_stage();
  scene.lights.push_back(
      {"spot", SpotLight{{2.4, 3.4, 1.6}, {-2.4, -2.6, -1.6}, Vec3{36}, 30, 0.15}});
  scene.influence_areas.declared = {
      PointAreaDeclaration{"bulb", {1.6, -2.2, -2.2}, {60, 60}, 0, 10},
      PlaneAreaDeclaration{"sun", {1.6, 4.2, 1.6}, {-1, -2, -1}, {3.6, 3.6}, 8}};
  if (mesh == shapes) {
    add_shapes(scene);
  } else if (mesh == terrain) {
    add_terrain(scene);
  } else {
    put_on_stage(scene, read_mesh(file_of(mesh)));
  }
  return scene;
}

}  // namespace

MeshScene::MeshScene(const std::string& mesh) {
  const Scene scene = is_generated(mesh) ? generated_scene(mesh) : scene_with(mesh);
  film = scene.film;
  render = scene.render;
  world = make_world(scene);
  render.samples = 8;
  const InfluenceSettings declared{false, scene.influence_areas.declared};
  for (const SceneArea& area : areas_of(world, declared, film))
    areas.push_back({area.area, area.bundle});
}

std::vector<std::string> mesh_names() {
  std::vector<std::string> names{shapes};
  for (const std::string mesh : mesh_files) {
    if (fs::exists(file_of(mesh))) {
      names.push_back(mesh);
    } else {
      std::fprintf(stderr, "skipped: everything on %s, as there is no %s (PAHRENDER_MESHES)\n",
                   mesh.c_str(), file_of(mesh).c_str());
    }
  }
  return names;
}

const MeshScene& mesh_scene(const std::string& mesh) {
  static std::map<std::string, MeshScene> kept;
  return kept.try_emplace(mesh, mesh).first->second;
}

}  // namespace pah::bench
