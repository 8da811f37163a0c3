#include "catch.hpp"

#include <cmath>
#include <pah/scene/placement.hpp>
#include <pah/scene/shapes.hpp>
#include <pah/scene/world.hpp>

#include "support/mesh_checks.hpp"

using namespace pah;

namespace {

Mesh mesh_of(const World& world) { return {"", world.positions, {}, {}, world.indices, {}}; }

Scene scene_of(const Shape& shape, const glm::dmat4x3& transform = glm::dmat4x3{1.0}) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(make_mesh(shape));
  scene.meshes.back().name = "thing";
  scene.instances.push_back({0, 0, no_light, transform});
  return scene;
}

glm::dmat4x3 translation(const DVec3& t) { return {DVec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t}; }
glm::dmat4x3 scaling(const DVec3& s) { return {DVec3{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }

// Shading normals lie on the same side as geometric normals.
bool normals_agree(const World& world) {
  for (const UVec3& t : world.indices) {
    const Vec3 a = world.positions[t.x], b = world.positions[t.y], c = world.positions[t.z];
    for (int k = 0; k < 3; ++k)
      if (!(glm::dot(world.normals[t[k]], glm::cross(b - a, c - a)) > 0)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("An empty scene is an empty world") {
  const World world = make_world(Scene{});
  CHECK(world.origin == DVec3(0));
  CHECK(world.triangles().size() == 0);
  CHECK(world.bounds.empty());
}

TEST_CASE("Instances become consecutive triangles") {
  Scene scene = scene_of(BoxShape{}, translation({-2, 0, 0}));
  scene.materials.emplace_back();
  scene.lights.push_back({"panel", AreaLight{}});
  Mesh flat = make_mesh(RectangleShape{});
  flat.normals.clear();
  flat.uvs.clear();
  scene.meshes.push_back(flat);
  scene.instances.push_back({1, 1, 0, translation({2, 0, 0})});
  scene.instances.push_back({0, 0, no_light, translation({4, 1, 0})});
  const World world = make_world(scene);

  REQUIRE(world.surfaces.size() == 3);
  CHECK(world.triangles().size() == 26);
  CHECK(world.surfaces[1].first_triangle == 12);
  CHECK(world.surfaces[1].triangle_count == 2);
  CHECK(world.surfaces[1].light == 0);
  CHECK_FALSE(world.surfaces[1].has_normals);
  CHECK(world.surfaces[2].has_uvs);
  for (std::uint32_t s = 0; s < 3; ++s)
    for (std::uint32_t i = 0; i < world.surfaces[s].triangle_count; ++i)
      CHECK(world.surface_of_triangle[world.surfaces[s].first_triangle + i] == s);
  CHECK(world.normals.size() == world.positions.size());
  CHECK(world.uvs.size() == world.positions.size());
  CHECK(world.origin == DVec3(1, 0.5, 0));
  CHECK(world.bounds == Aabb{{-3.5F, -1, -0.5F}, {3.5F, 1, 0.5F}});
  CHECK(volume_of(mesh_of(world)) > 0);
  CHECK(world.bytes() >= world.positions.size() * 12 + world.indices.size() * 16);
}

TEST_CASE("Mirrored instances keep their outside") {
  for (const DVec3& s : {DVec3{1, 1, 1}, DVec3{-1, 1, 1}, DVec3{2, -3, 0.1}, DVec3{-1, -1, -1},
                         DVec3{-1e-9, 1e-9, 1e-9}}) {
    const World world = make_world(scene_of(TorusShape{}, scaling(s)));
    const Mesh mesh = mesh_of(world);
    CHECK(is_closed(mesh));
    CHECK(volume_of(mesh) > 0);
    CHECK(normals_agree(world));
  }
}

TEST_CASE("Normals go by the inverse transpose") {
  const World world = make_world(scene_of(SphereShape{}, scaling({1, 4, 1})));
  // On the ellipsoid x^2 + (y / 4)^2 + z^2 = r^2 the normal is along (x, y / 16, z).
  for (std::size_t i = 0; i < world.positions.size(); ++i) {
    const Vec3 p = world.positions[i];
    CHECK(glm::distance(world.normals[i], glm::normalize(Vec3(p.x, p.y / 16, p.z))) < 1e-5F);
  }
}

TEST_CASE("A scene far away loses nothing") {
  Scene near = scene_of(SphereShape{}, scaling(DVec3{0.5}));
  Scene far = near;
  const DVec3 away{1e6, -1e6, 1048576.5};
  far.instances[0].world_from_object =
      compose(translation(away), far.instances[0].world_from_object);
  for (Scene* scene : {&near, &far}) {
    const DVec3 by = scene == &far ? away : DVec3{0};
    PerspectiveCamera camera;
    camera.position += by;
    camera.look_at += by;
    scene->camera = camera;
    scene->lights.push_back({"bulb", PointLight{DVec3{0, 3, 0} + by}});
    scene->lights.push_back({"spot", SpotLight{DVec3{0, 4, 0} + by}});
    scene->lights.push_back({"sun", DirectionalLight{}});
  }
  const World a = make_world(near);
  const World b = make_world(far);
  // Double holds 1e6 to 1e-10, far finer than the floats' 1e-8 here.
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    CHECK(glm::distance(a.positions[i], b.positions[i]) < 3e-8F);
  CHECK(glm::distance(b.origin, away) < 1e-9);
  const auto& recentered = std::get<PerspectiveCamera>(b.camera);
  CHECK(glm::distance(recentered.position, DVec3(0, 1, 5)) < 1e-9);
  CHECK(glm::distance(recentered.look_at, DVec3(0)) < 1e-9);
  CHECK(glm::distance(std::get<PointLight>(b.lights[0].model).position, DVec3(0, 3, 0)) < 1e-9);
  CHECK(glm::distance(std::get<SpotLight>(b.lights[1].model).position, DVec3(0, 4, 0)) < 1e-9);
}

TEST_CASE("A scene scaled by a power of 2 is the same world, scaled") {
  const glm::dmat4x3 odd{
      DVec3{0.3, 0.1, -0.7}, {-0.2, 1.1, 0.3}, {0.9, 0.4, -0.1}, {0.123, 4.56, -7.89}};
  const World world = make_world(scene_of(TorusShape{}, odd));
  for (int k = -20; k <= 20; k += 5) {
    const double factor = std::ldexp(1.0, k);
    const World scaled = make_world(scene_of(TorusShape{}, compose(scaling(DVec3{factor}), odd)));
    CHECK(scaled.origin == world.origin * factor);
    CHECK(scaled.indices == world.indices);
    CHECK(scaled.normals == world.normals);
    for (std::size_t i = 0; i < world.positions.size(); ++i)
      REQUIRE(scaled.positions[i] == world.positions[i] * static_cast<float>(factor));
  }
}

TEST_CASE("Unused vertices do not move the origin") {
  Scene scene = scene_of(BoxShape{});
  scene.meshes[0].normals.clear();
  scene.meshes[0].uvs.clear();
  scene.meshes[0].positions.emplace_back(1e9F, 0, 0);
  CHECK(make_world(scene).origin == DVec3(0));
}

TEST_CASE("Faults are named") {
  const auto message = [](const Scene& scene) -> std::string {
    try {
      (void)make_world(scene);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  Scene scene = scene_of(BoxShape{}, scaling(DVec3{1e300}));
  CHECK(message(scene).find("'thing': a position is not finite") != std::string::npos);
  scene = scene_of(BoxShape{}, translation({NAN, 0, 0}));
  CHECK(message(scene).find("'thing': a position is not finite") != std::string::npos);
  scene = scene_of(BoxShape{}, scaling({1, 0, 1}));
  CHECK(message(scene).find("'thing': its transform") != std::string::npos);
  scene = scene_of(BoxShape{});
  scene.meshes[0].triangles[3].y = 24;
  CHECK(message(scene).find("'thing': a triangle has an index that is not a vertex of its mesh") !=
        std::string::npos);
  scene = scene_of(BoxShape{});
  scene.meshes[0].positions[3].y = NAN;
  CHECK(message(scene).find("'thing': a position") != std::string::npos);
  scene = scene_of(BoxShape{});
  scene.meshes[0].normals[3] = Vec3(0);
  CHECK(message(scene).find("'thing': a normal") != std::string::npos);
  scene = scene_of(BoxShape{});
  scene.instances[0].material = 1;
  CHECK(message(scene).find("'thing': its instance refers to a material that does not exist") !=
        std::string::npos);
  // Tiny scenes are fine.
  CHECK(message(scene_of(BoxShape{}, scaling(DVec3{1e-40}))).empty());
}

TEST_CASE("A camera inside a closed mesh without light causes a warning") {
  const auto warnings = [](const Scene& scene) { return make_world(scene).warnings; };
  Scene scene = scene_of(BoxShape{}, translation({3, 0, 0}));
  PerspectiveCamera camera;
  camera.position = {3.2, 0.1, -0.3};
  scene.camera = camera;
  CHECK(warnings(scene) == std::vector<std::string>{
                               "the camera is inside mesh 'thing', which is closed: no light gets "
                               "in"});
  SECTION("A camera outside causes none") {
    camera.position.x = 3.6;
    scene.camera = camera;
    CHECK(warnings(scene).empty());
  }
  SECTION("A lamp inside prevents it") {
    scene.lights.push_back({"bulb", PointLight{{3, 0.4, 0}}});
    CHECK(warnings(scene).empty());
  }
  SECTION("A lamp outside does not prevent it") {
    scene.lights.push_back({"bulb", PointLight{{3, 0.6, 0}}});
    CHECK(warnings(scene).size() == 1);
  }
  SECTION("Glass prevents it") {
    scene.materials[0].model = GlassMaterial{};
    CHECK(warnings(scene).empty());
  }
  SECTION("An opening prevents it") {
    scene.meshes[0].triangles.pop_back();
    CHECK(warnings(scene).empty());
  }
  SECTION("A mirrored object causes it too") {
    scene.instances[0].world_from_object[0] *= -1;
    CHECK(warnings(scene).size() == 1);
  }
}

TEST_CASE("One distant object costs the others no precision") {
  Scene scene;
  PerspectiveCamera camera;
  camera.position = {0, 2, 6};
  camera.look_at = {0, 1, 0};
  scene.camera = camera;
  scene.materials.emplace_back();
  scene.meshes = {make_mesh(SphereShape{}), make_mesh(RectangleShape{})};
  for (std::uint32_t i = 0; i < 2; ++i) {
    Instance instance;
    instance.mesh = i;
    scene.instances.push_back(instance);
  }
  const World alone = make_world(scene);
  CHECK(alone.warnings.empty());
  CHECK(alone.origin == DVec3(0));  // the center
  for (const DVec3& far : {DVec3(1e7, 0, 0), DVec3(1e7, 1e7, 1e7), DVec3(0, 0, -1e12)}) {
    CAPTURE(far.x, far.y, far.z);
    Scene with = scene;
    with.instances.push_back(scene.instances[0]);
    with.instances.back().world_from_object[3] = far;
    const World world = make_world(with);
    double error = 0;
    for (std::size_t i = 0; i < alone.positions.size(); ++i)
      error = std::max(error, glm::distance(DVec3(world.positions[i]) + world.origin,
                                            DVec3(alone.positions[i]) + alone.origin));
    CHECK(error < 2e-6);
    REQUIRE(world.warnings.size() == 1);
    CHECK_THAT(world.warnings[0], contains_text("rounding destroys its shape"));
  }
  // A camera with a long lens does not take the origin along.
  camera.position = {0, 0, 1e6};
  camera.fov = 1e-4;
  scene.camera = camera;
  CHECK(make_world(scene).origin == DVec3(0));
}

TEST_CASE("The same one of several faults is reported every time") {
  Scene scene = scene_of(SphereShape{1, 200, 200});
  Mesh& mesh = scene.meshes[0];
  REQUIRE(mesh.positions.size() > 30'000);
  mesh.uvs.resize(mesh.positions.size());
  for (int i = 0; i < 20; ++i) {
    // The faults are far apart, so that different threads find them.
    mesh.positions[1] = Vec3(NAN);
    mesh.uvs[mesh.positions.size() - 1] = Vec2(NAN);
    CHECK_THROWS_WITH(make_world(scene), contains_text("a texture coordinate is not finite"));
    std::swap(mesh.positions[1], mesh.positions[mesh.positions.size() - 1]);
    std::swap(mesh.uvs[1], mesh.uvs[mesh.positions.size() - 1]);
    CHECK_THROWS_WITH(make_world(scene), contains_text("a texture coordinate is not finite"));
  }
}
