// Influence areas declared by hand, well or badly, never change a pixel.
#include <filesystem>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>

#include "catch.hpp"
#include "reference.hpp"
#include "support/paths.hpp"

using namespace pah;

namespace {

// Declares areas for every light and camera whose rays share a point or a direction: areas that
// overlap and cut triangles, an area with a near plane, a tiny area and the derived areas.
std::vector<LocalArea> many_areas(const Scene& scene, const World& world) {
  InfluenceSettings settings;
  const auto add_point = [&](const std::string& light, const DVec3& forward, const DVec2& fov,
                             double near, double far) {
    settings.declared.emplace_back(PointAreaDeclaration{light, forward, fov, near, far});
  };
  const auto declare_point = [&](const std::string& light, const DVec3& forward) {
    add_point(light, forward, {1e-4, 1e-4}, 0, 9);
    add_point(light, forward, {20, 30}, 0.5, 9);
    add_point(light, forward, {30, 20}, 0, 3);
    add_point(light, forward + DVec3(0.3, 0, 0.2), {120, 90}, 1, 4);
  };
  const auto declare_plane = [&](const std::string& light, const DVec3& direction) {
    settings.declared.emplace_back(
        PlaneAreaDeclaration{light, {0, 1, 0}, direction, {1e-5, 1e-5}, 2});
    settings.declared.emplace_back(PlaneAreaDeclaration{light, {0.3, 1, 0}, direction, {2, 1}, 1});
    settings.declared.emplace_back(PlaneAreaDeclaration{light, {0, 3, 0}, direction, {9, 2}, 5});
    settings.declared.emplace_back(PlaneAreaDeclaration{light, {0, 2, 0}, {0, -1, 0.1}, {3, 3}, 2});
  };
  for (const Light& light : scene.lights) {
    if (const auto* spot = std::get_if<SpotLight>(&light.model))
      declare_point(light.name, spot->direction);
    if (std::holds_alternative<PointLight>(light.model)) declare_point(light.name, {0, -1, -0.5});
    if (const auto* sun = std::get_if<DirectionalLight>(&light.model))
      declare_plane(light.name, sun->direction);
  }
  if (const auto* camera = std::get_if<PerspectiveCamera>(&scene.camera)) {
    if (camera->aperture_radius == 0) declare_point("camera", camera->look_at - camera->position);
  } else {
    const auto& view = std::get<OrthographicCamera>(scene.camera);
    declare_plane("camera", view.look_at - view.position);
  }
  std::vector<LocalArea> areas;
  for (const SceneArea& area : areas_of(world, settings, scene.film))
    areas.push_back(local_area(area));
  return areas;
}

bool identical(const FilmPixel& a, const FilmPixel& b) {
  return a.sum == b.sum && a.error == b.error && a.sum_of_squares == b.sum_of_squares &&
         a.samples == b.samples && a.hits == b.hits;
}

std::size_t differing_pixels(const Film& a, const Film& b) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    differing += identical(a.pixels[i], b.pixels[i]) ? 0U : 1U;
  return differing;
}

Film render_few(const World& world, const Accelerator& accelerator, const Scene& scene) {
  RenderSettings settings = scene.render;
  settings.samples = 4;
  FilmSettings film = scene.film;
  film.albedo = film.normal = film.depth = true;
  RenderOptions options;
  options.count_traversal = true;
  return render(world, accelerator, film, settings, options).film;
}

// Returns every heuristic and split, with every top level and some tolerances or with one of these.
std::vector<LocalConfig> configs(bool all) {
  std::vector<TopLevelConfig> top_levels{{.kind = TopLevelKind::none}};
  for (const TopLevelKind kind : {TopLevelKind::list, TopLevelKind::octree})
    for (const double tolerance : {0.0, 0.1, 4.0})
      top_levels.push_back({kind, tolerance == 0.1 ? 0 : 4, tolerance});
  std::vector<LocalConfig> configs;
  for (const auto heuristic :
       {Heuristic::surface_area, Heuristic::projected_area, Heuristic::mean_direction})
    for (const auto split : {SplitAxis::best, SplitAxis::longest, SplitAxis::facing})
      for (std::size_t i = 0; i < (all ? top_levels.size() : 1); ++i) {
        LocalConfig config;
        config.heuristic = heuristic;
        config.split = split;
        config.top_level = top_levels[(configs.size() + 1) % top_levels.size()];
        configs.push_back(config);
      }
  return configs;
}

void check_pictures(const std::string& name, const std::vector<LocalConfig>& configs) {
  CAPTURE(name);
  const Scene scene = golden::load_golden(name).scene;
  const World world = make_world(scene);
  const std::vector<LocalArea> areas = many_areas(scene, world);
  REQUIRE(areas.size() > 3);
  const Film expected = render_few(world, *make_brute_force(world.triangles()), scene);
  std::uint64_t asked_of_bundles = 0, most_asked = 0;
  for (const LocalConfig& config : configs) {
    const auto local = make_local_bvhs(world.triangles(), areas, config);
    const Film film = render_few(world, *local, scene);
    REQUIRE(film.pixels.size() == expected.pixels.size());
    CHECK(differing_pixels(film, expected) == 0);
    CHECK(film.features.size() == film.pixels.size());
    CHECK(film.features == expected.features);
    // Checks that the areas were used and answered rays that do not leave them.
    std::uint64_t asked = 0, answered = 0;
    for (const LocalBvhUse& use : local->uses()) {
      asked += use.asked;
      answered += use.answered;
    }
    CHECK(asked > 1000);
    CHECK(answered > 100);
    const TopLevelConfig& top_level = config.top_level;
    if (top_level.kind == TopLevelKind::none) asked_of_bundles = asked;
    if (top_level.direction_tolerance > 3) most_asked = asked;
  }
  // A top level finds areas for rays without a bundle; "lamps" has direct light only.
  if (asked_of_bundles > 0 && name != "lamps") CHECK(most_asked > asked_of_bundles);
}

}  // namespace

TEST_CASE("Influence areas give the same golden pictures as brute force to the last bit") {
  for (const std::string name : {"lamps", "columns", "scattered", "orthographic"})
    check_pictures(name, configs(false));
}

TEST_CASE("Influence areas give the same golden pictures, however they are built and found",
          "[full]") {
  for (const std::string name : {"lamps", "columns", "scattered", "orthographic"})
    check_pictures(name, configs(true));
}

TEST_CASE("Influence areas change no pixel of the example scenes, however they are built and found",
          "[full]") {
  std::uint64_t asked = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::source_folder() / "scenes")) {
    if (file.path().extension() != ".yaml") continue;
    CAPTURE(file.path());
    Scene scene = load_scene(file.path()).scene;
    scene.film.height = 64 * scene.film.height / scene.film.width;
    scene.film.width = 64;
    const World world = make_world(scene);
    const std::vector<LocalArea> areas = many_areas(scene, world);
    const Film expected = render_few(world, *make_global_bvh(world.triangles()), scene);
    // With many lights, building all areas would take an hour.
    constexpr std::size_t most_areas = 24;
    const std::span<const LocalArea> some(areas.data(), std::min(areas.size(), most_areas));
    for (const LocalConfig& config : configs(false)) {
      const auto local = make_local_bvhs(world.triangles(), {some.begin(), some.end()}, config);
      const Film film = render_few(world, *local, scene);
      REQUIRE(film.pixels.size() == expected.pixels.size());
      CHECK(differing_pixels(film, expected) == 0);
      for (const LocalBvhUse& use : local->uses()) asked += use.asked;
    }
  }
  CHECK(asked > 1'000'000);
}
