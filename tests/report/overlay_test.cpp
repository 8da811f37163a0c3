// Tests lines drawn over pictures: their positions, and the surfaces that hide them.
#include "report/inspect/pictures/overlay.hpp"

#include <algorithm>
#include <pah/render/render.hpp>
#include <pah/scene/shapes.hpp>

#include "catch.hpp"
#include "render/path/camera_rays.hpp"

using namespace pah;

namespace {

constexpr int width = 48, height = 32;

// Seen from (0, 0, 4) along -z: a wall in the plane z = 0 that fills the picture.
Scene wall(bool is_perspective) {
  Scene scene;
  if (is_perspective) {
    PerspectiveCamera camera;
    camera.position = {0, 0, 4};
    camera.fov = 90;
    scene.camera = camera;
  } else {
    OrthographicCamera camera;
    camera.position = {0, 0, 4};
    camera.height = 4;
    scene.camera = camera;
  }
  scene.film.width = width;
  scene.film.height = height;
  scene.render.samples = 2;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(RectangleShape{{1000, 1000}})};
  Instance instance;
  instance.world_from_object = glm::dmat4x3(1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0);
  scene.instances.push_back(instance);
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 0, 3), Vec3(4)}});
  return scene;
}

struct Drawn {
  Image before, after;

  [[nodiscard]] bool is_changed(int x, int y) const { return before.at(x, y) != after.at(x, y); }
  [[nodiscard]] std::ptrdiff_t changed() const {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i)
      count += before.pixels[i] != after.pixels[i] ? 1 : 0;
    return count;
  }
  // Returns the coverage of a pixel by the red line.
  [[nodiscard]] float share(int x, int y) const {
    return (before.at(x, y).g - after.at(x, y).g) / before.at(x, y).g;
  }
};

// Returns a red line between two points of the scene.
Drawn draw(const Scene& scene, const DVec3& from, const DVec3& to) {
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene, "bvh");
  const LineSet line{
      "line", Vec3(1, 0, 0), {Vec3(from - world.origin), Vec3(to - world.origin)}, {{0, 1}}};
  Drawn drawn{draft_picture(world, *acceleration.accelerator, scene), {}};
  drawn.after = drawn.before;
  draw_over(drawn.after, world, *acceleration.accelerator, scene.film, {}, {line});
  return drawn;
}

}  // namespace

TEST_CASE("A point on a pixel's central ray is projected to its center") {
  FilmSettings film;
  film.width = width;
  film.height = height;
  PerspectiveCamera perspective;
  perspective.position = {3, 2, -5};
  perspective.look_at = {1, -1, 2};
  perspective.up = {0.3, 1, 0.2};
  perspective.fov = 70;
  const OrthographicCamera orthographic{.position = perspective.position,
                                        .look_at = perspective.look_at,
                                        .up = perspective.up,
                                        .height = 3};
  for (const Camera& camera : {Camera(perspective), Camera(orthographic)}) {
    const CameraRays rays(camera, film);
    for (int y = 0; y < height; y += 3)
      for (int x = 0; x < width; x += 5) {
        const Ray ray = rays.central(x, y);
        const Vec4 place = rays.project(ray.origin + 4.0F * ray.direction);
        CHECK(place.z > 0);
        CHECK(place.x / place.w == Approx(x + 0.5).margin(1e-3));
        CHECK(place.y / place.w == Approx(y + 0.5).margin(1e-3));
      }
  }
}

TEST_CASE("The draft is the render, as PNG files show it") {
  Scene scene = wall(true);
  std::get<PointLight>(scene.lights[0].model).intensity = Vec3(100);
  scene.film.exposure = 1;
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene, "bvh");
  Image expected =
      radiance_of(render(world, *acceleration.accelerator, scene.film, scene.render).film);
  for (Vec3& pixel : expected.pixels) pixel = glm::min(2.0F * pixel, 1.0F);
  CHECK(std::ranges::any_of(expected.pixels, [](const Vec3& pixel) { return pixel.x == 1; }));
  scene.film.crop = PixelRect{0, 1, 0, 1};
  CHECK(draft_picture(world, *acceleration.accelerator, scene).pixels == expected.pixels);
}

TEST_CASE("A line is drawn where the camera sees it, and nothing else is") {
  // Through the middle of the pixels of row 11 from x = 30 to 40 at the depth 2, in which the
  // picture is 6 x 4 by perspective and 4 high, too, without.
  const auto at = [](double x, double y) {
    return DVec3((x / width - 0.5) * 6, (0.5 - y / height) * 4, 2);
  };
  for (const bool is_perspective : {true, false}) {
    const Drawn drawn = draw(wall(is_perspective), at(30, 11.5), at(40, 11.5));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        INFO(x << ", " << y);
        if (x >= 30 && x < 40) {
          // The line is 1.6 pixels wide: it covers all of a row, and 0.3 of its neighbors.
          const float share = y == 11 ? 1.0F : y == 10 || y == 12 ? 0.3F : 0.0F;
          CHECK(drawn.share(x, y) == Approx(share).margin(1e-3));
        } else if (x < 29 || x > 40) {
          CHECK_FALSE(drawn.is_changed(x, y));
        }
      }
  }
}

TEST_CASE("A line that goes into the picture is hidden from the wall on") {
  // The line meets the wall at x = 1: 3 pixels right of the middle by perspective.
  const Drawn drawn = draw(wall(true), DVec3(0, 0, 1), DVec3(3, 0, -2));
  const double scale = height / 2.0;
  const auto row = height / 2;
  const int border = static_cast<int>(width / 2.0 + scale * 1 / 4);
  const int end = static_cast<int>(width / 2.0 + scale * 3 / 6);
  for (int x = width / 2; x < end; ++x) {
    INFO(x);
    const float share = drawn.share(x, row);
    if (x < border) CHECK(share > 0.7F);
    if (x > border) CHECK(share == Approx(0.25F * 0.8F).epsilon(0.02));
  }
}

TEST_CASE("A line on the wall is not hidden, one behind it is faint") {
  const auto share_at = [](double z) {
    const double y = (4 - z) / height;  // the middle of a pixel
    return draw(wall(true), DVec3(-1, y, z), DVec3(1, y, z)).share(width / 2, height / 2 - 1);
  };
  CHECK(share_at(3) == Approx(1));
  CHECK(share_at(0) == Approx(1));
  CHECK(share_at(-1) == Approx(0.25));
}

TEST_CASE("Boxes are thin, and under the areas") {
  const Scene scene = wall(true);
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene, "bvh");
  const auto line = [&](const Vec3& color) {  // through the middle of the pixels of row 15
    const DVec3 middle = DVec3(0, 1.0 / height, 3) - world.origin;
    return LineSet{
        "line", color, {Vec3(middle - DVec3(1, 0, 0)), Vec3(middle + DVec3(1, 0, 0))}, {{0, 1}}};
  };
  const LineSet red = line(Vec3(1, 0, 0)), green = line(Vec3(0, 1, 0)), blue = line(Vec3(0, 0, 1));
  const auto drawn = [&](const std::vector<LineSet>& boxes, const std::vector<LineSet>& areas) {
    Image picture{width, height, std::vector<Vec3>(width * height, Vec3(0))};
    draw_over(picture, world, *acceleration.accelerator, scene.film, boxes, areas);
    CHECK(picture.at(width / 2, 14) == picture.at(width / 2, 16));
    return picture.at(width / 2, 15);
  };
  CHECK(glm::distance(drawn({red}, {}), Vec3(0.6, 0, 0)) < 1e-3F);
  // The first level is over the second.
  CHECK(glm::distance(drawn({red, green}, {}), Vec3(0.6, 0.24, 0)) < 1e-3F);
  CHECK(glm::distance(drawn({red, green}, {blue}), Vec3(0, 0, 1)) < 1e-3F);
}

TEST_CASE("Lines before nothing are not hidden") {
  Scene scene = wall(true);
  scene.instances.clear();
  const Drawn drawn = draw(scene, DVec3(-9, 0.1, -1000), DVec3(999, 0.1, -1000));
  CHECK(drawn.after.at(width / 2, height / 2 - 1).r > 0.7F);
}

TEST_CASE("What is behind the camera is not drawn") {
  for (const bool is_perspective : {true, false}) {
    const Scene scene = wall(is_perspective);
    CHECK(draw(scene, DVec3(-1, 0.3, 5), DVec3(1, 0.3, 5)).changed() == 0);
    CHECK(draw(scene, DVec3(0, 0, 4.5), DVec3(2, 1, 9)).changed() == 0);
  }
  // A line that passes the camera on its right leaves the picture there and appears nowhere else.
  const Drawn passing = draw(wall(true), DVec3(0.5, 0, 2), DVec3(0.5, 0, 6));
  CHECK(passing.is_changed(width - 1, height / 2));
  for (int x = 0; x < width / 2; ++x) CHECK_FALSE(passing.is_changed(x, height / 2));
}

TEST_CASE("A line from the eye is a point") {
  const Drawn drawn = draw(wall(true), DVec3(0, 0, 4), DVec3(1, 0.5, 2));
  CHECK(drawn.is_changed(width / 2 + 8, height / 2 - 4));
  CHECK(drawn.changed() == 4);
}
