// Derived areas hold the rays of their light; declared areas stay where they were declared.
#include <algorithm>
#include <pah/scene/areas.hpp>
#include <pah/scene/shapes.hpp>
#include <random>

#include "catch.hpp"
#include "render/path/camera_rays.hpp"

using namespace pah;

namespace {

// Returns a scene with a box of 4 x 2 x 6 about `center`.
Scene scene_about(const DVec3& center) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(make_mesh(BoxShape{}));
  scene.instances.push_back(
      {0, 0, no_light, {DVec3{4, 0, 0}, DVec3{0, 2, 0}, DVec3{0, 0, 6}, center}});
  PerspectiveCamera view;
  view.position = center + DVec3{1, 2, 9};
  view.look_at = center;
  scene.camera = view;
  return scene;
}

std::vector<SceneArea> areas_in(const Scene& scene) {
  return areas_of(make_world(scene), scene.influence_areas, scene.film);
}

std::vector<SceneArea> of_bundle(const std::vector<SceneArea>& areas, std::uint32_t bundle) {
  std::vector<SceneArea> found;
  for (const SceneArea& area : areas)
    if (area.bundle == bundle) found.push_back(area);
  return found;
}

Vec3 random_point(const Aabb& box, std::mt19937& random) {
  Vec3 point;
  for (int k = 0; k < 3; ++k)
    point[k] = std::uniform_real_distribution<float>(box.min[k], box.max[k])(random);
  return point;
}

bool hold(const std::vector<SceneArea>& areas, const Vec3& point) {
  for (const SceneArea& area : areas)
    if (contains(region_of(area.area), point)) return true;
  return false;
}

// Returns the distance at which a ray leaves the box; negative if it misses the box.
double leaves_box(const Ray& ray, const Aabb& box) {
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double a = (double{box.min[k]} - ray.origin[k]) / ray.direction[k];
    const double b = (double{box.max[k]} - ray.origin[k]) / ray.direction[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? far : -1;
}

const std::vector<DVec3> light_positions{{0, 0, 0},      {0.5, 0.3, -2},  {0, 5, 0},    {9, 1, 0.1},
                                         {-3, -3, -3},   {2, 1, 3},       {2, 0.5, -1}, {0, 1, 0},
                                         {100, 90, -80}, {0, 1 + 1e-7, 0}};

}  // namespace

TEST_CASE("A point light's frusta hold every segment that leads to it from the scene's box") {
  std::mt19937 random(1);
  for (const DVec3& center : {DVec3(0), DVec3(1e6, -3e5, 7)}) {
    Scene scene = scene_about(center);
    for (const DVec3& position : light_positions)
      scene.lights.push_back({"lamp", PointLight{center + position, Vec3(1)}});
    const World world = make_world(scene);
    const auto areas = areas_of(world, scene.influence_areas, scene.film);
    for (std::uint32_t light = 0; light < light_positions.size(); ++light) {
      CAPTURE(light);
      const auto own = of_bundle(areas, light);
      CHECK(!own.empty());
      for (const SceneArea& area : own) {
        const Frustum& frustum = std::get<PointArea>(area.area).frustum;
        CHECK(frustum.near == 0);
        // Segments aim at the position rounded to float.
        const auto& model = std::get<PointLight>(world.lights[light].model);
        CHECK(contains(frustum, Vec3(model.position)));
      }
      int outside = 0;
      for (int i = 0; i < 2000; ++i) {
        Vec3 point = random_point(world.bounds, random);
        // Half of the points lie just outside a face, as offset_point moves them.
        if (i % 2 == 0) point.y = std::nextafterf(world.bounds.max.y, 2 * world.bounds.max.y);
        outside += hold(own, point) ? 0 : 1;
      }
      CHECK(outside == 0);
    }
  }
}

TEST_CASE("Empty frusta are not derived") {
  Scene scene = scene_about(DVec3(0));
  scene.lights.push_back({"middle", PointLight{DVec3(0), Vec3(1)}});
  scene.lights.push_back({"above", PointLight{DVec3(0, 50, 0), Vec3(1)}});
  SpotLight turned_away;
  turned_away.position = DVec3(0, 5, 0);
  turned_away.direction = DVec3(0, 1, 0);
  scene.lights.push_back({"turned away", turned_away});
  const auto areas = areas_in(scene);
  CHECK(of_bundle(areas, 0).size() == 6);
  REQUIRE(of_bundle(areas, 1).size() == 1);
  CHECK(of_bundle(areas, 1)[0].name == "above -y");
  CHECK(of_bundle(areas, 1)[0].light == "above");
  CHECK(of_bundle(areas, 2).empty());
}

TEST_CASE("A spot's frustum holds every segment that leads to it within its cone") {
  std::mt19937 random(2);
  for (const double angle : {1.0, 11.0, 45.0, 79.0, 85.0, 90.0}) {
    CAPTURE(angle);
    for (const DVec3& direction : {DVec3(0, -1, 0), DVec3(0.3, -2, 0.7)}) {
      Scene scene = scene_about(DVec3(10, 20, 30));
      SpotLight spot;
      spot.position = DVec3(11, 24, 30.5);
      spot.direction = direction;
      spot.angle = angle;
      scene.lights.push_back({"spot", spot});
      const World world = make_world(scene);
      const auto areas = of_bundle(areas_of(world, scene.influence_areas, scene.film), 0);
      CHECK((angle < 80 ? areas.size() == 1 : areas.size() > 1));
      const DVec3 eye = std::get<SpotLight>(world.lights[0].model).position;
      int inside = 0, lost = 0;
      for (int i = 0; i < 4000; ++i) {
        const Vec3 point = random_point(world.bounds, random);
        const double cosine =
            glm::dot(glm::normalize(DVec3(point) - eye), glm::normalize(direction));
        if (cosine < std::cos(glm::radians(angle))) continue;
        ++inside;
        lost += hold(areas, point) ? 0 : 1;
      }
      CHECK((inside > 0 || angle < 5));
      CHECK(lost == 0);
    }
  }
}

TEST_CASE("A sun's box holds the scene, and a sun with an angle derives no box") {
  for (const DVec3& direction : {DVec3(0, -1, 0), DVec3(-1, -2, -1), DVec3(5, 0, 0)}) {
    Scene scene = scene_about(DVec3(3, -5, 1e5));
    scene.lights.push_back({"sun", DirectionalLight{direction, Vec3(1), 0}});
    scene.lights.push_back({"real sun", DirectionalLight{direction, Vec3(1), 0.53}});
    const World world = make_world(scene);
    const auto areas = areas_of(world, scene.influence_areas, scene.film);
    const auto own = of_bundle(areas, 0);
    REQUIRE(own.size() == 1);
    CHECK(own[0].name == "sun");
    CHECK(type_name(own[0].area) == "plane");
    CHECK(contains(region_of(own[0].area), world.bounds));
    CHECK(glm::dot(std::get<PlaneArea>(own[0].area).box.axes[2], glm::normalize(direction)) ==
          Approx(1));
    CHECK(of_bundle(areas, 1).empty());
  }
}

TEST_CASE("The camera's area holds its rays to the end of the scene") {
  Scene scene = scene_about(DVec3(-7, 100, 3));
  scene.film.width = 40;
  scene.film.height = 25;
  auto pinhole = std::get<PerspectiveCamera>(scene.camera);
  pinhole.position += DVec3(0.1, 0.2, 0.3);  // not a float
  PerspectiveCamera inside = pinhole;
  inside.position = pinhole.look_at;
  inside.look_at = pinhole.look_at + DVec3(1, 0.2, 0.1);
  const std::vector<Camera> cameras{
      pinhole, inside, OrthographicCamera{pinhole.position, pinhole.look_at, DVec3(0.1, 1, 0), 3}};
  for (const Camera& camera : cameras) {
    CAPTURE(camera.index());
    scene.camera = camera;
    const World world = make_world(scene);
    const auto areas = of_bundle(areas_of(world, scene.influence_areas, scene.film), camera_bundle);
    REQUIRE(areas.size() == 1);
    const Region region = region_of(areas[0].area);
    const CameraRays rays(world.camera, scene.film);
    int lost = 0, reaching = 0;
    for (int y = 0; y < scene.film.height; ++y)
      for (int x = 0; x < scene.film.width; ++x)
        for (std::uint32_t i = 0; i < 4; ++i) {
          DrawnNumbers drawn;
          drawn.set(0, Sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), i, 0));
          drawn.draw(rays.dimensions());
          NumberReader numbers(drawn, 0);
          const Ray ray = rays.generate(x, y, numbers).ray;
          CHECK(ray.bundle == camera_bundle);
          const double end = leaves_box(ray, world.bounds);
          reaching += end > 0 ? 1 : 0;
          lost += contains(region, ray.origin) && exit_distance(region, ray) >= end ? 0 : 1;
        }
    CHECK(reaching > 100);
    CHECK(lost == 0);
  }
}

TEST_CASE("Nothing is derived for rays without a common bundle, or without triangles") {
  Scene scene = scene_about(DVec3(0));
  scene.lights.push_back({"panel", AreaLight{}});
  scene.lights.push_back({"sky", EnvironmentLight{}});
  std::get<PerspectiveCamera>(scene.camera).aperture_radius = 0.1;
  CHECK(areas_in(scene).empty());

  scene.lights.push_back({"lamp", PointLight{}});
  CHECK(!areas_in(scene).empty());
  scene.influence_areas.derive = false;
  CHECK(areas_in(scene).empty());
  scene.influence_areas.derive = true;
  scene.instances.clear();
  CHECK(areas_in(scene).empty());
}

TEST_CASE("Declared areas are moved along with the scene") {
  std::vector<std::vector<SceneArea>> found;
  for (const DVec3& center : {DVec3(0), DVec3(1024, -512, 4096)}) {
    Scene scene = scene_about(center);
    scene.lights.push_back({"lamp", PointLight{center + DVec3(0.25, 3, 0.5), Vec3(1)}});
    scene.lights.push_back({"sun", DirectionalLight{DVec3(-1, -2, -1), Vec3(1), 0}});
    scene.influence_areas.derive = false;
    PlaneAreaDeclaration plane;
    plane.light = "sun";
    plane.position = center + DVec3(0, 2, 0);
    plane.size = DVec2(2, 3);
    plane.depth = 4;
    PointAreaDeclaration point;
    point.light = "lamp";
    point.fov = DVec2(90, 60);
    point.near = 0.5;
    point.far = 7;
    PointAreaDeclaration view = point;
    view.light = "camera";
    scene.influence_areas.declared = {plane, point, view, point};
    found.push_back(areas_in(scene));
  }
  REQUIRE(found[0].size() == 4);
  const std::vector<std::string> names{"sun", "lamp", "camera", "lamp 2"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(found[0][i].name == names[i]);
    CHECK(found[0][i].declared);
    CHECK(found[1][i].bundle == found[0][i].bundle);
  }
  CHECK(found[0][0].bundle == 1);
  CHECK(found[0][1].bundle == 0);
  CHECK(found[0][2].bundle == camera_bundle);
  for (const auto& areas : found) {
    const Obb& box = std::get<PlaneArea>(areas[0].area).box;
    CHECK(box.center == DVec3(0, 0, 0));
    CHECK(box.half_size == DVec3(1, 1.5, 2));
    const Frustum& frustum = std::get<PointArea>(areas[1].area).frustum;
    CHECK(frustum.eye == DVec3(0.25, 3, 0.5));
    CHECK(frustum.tan_half.x == Approx(1));
    CHECK(frustum.tan_half.y == Approx(std::tan(glm::radians(30.0))));
    CHECK(frustum.near == 0.5);
    CHECK(frustum.far == 7);
    CHECK(std::get<PointArea>(areas[2].area).frustum.eye == DVec3(1, 2, 9));
    CHECK(std::get<PointArea>(areas[2].area).measure == PointMeasure::plane);
  }
}

TEST_CASE("An area is declared for a light of its kind only") {
  Scene scene = scene_about(DVec3(0));
  scene.lights.push_back({"lamp", PointLight{}});
  scene.lights.push_back({"sun", DirectionalLight{}});
  const auto declare = [&](const AreaDeclaration& area) {
    scene.influence_areas.declared = {area};
    return areas_in(scene).size();
  };
  PlaneAreaDeclaration plane;
  PointAreaDeclaration point;
  plane.light = "sun";
  point.light = "lamp";
  CHECK(declare(plane) > 0);
  CHECK(declare(point) > 0);
  for (const char* name : {"lamp", "camera", "moon"}) {
    plane.light = name;
    CHECK_THROWS_AS(declare(plane), std::invalid_argument);
  }
  for (const char* name : {"sun", "moon"}) {
    point.light = name;
    CHECK_THROWS_AS(declare(point), std::invalid_argument);
  }
}
