// Loading valid scenes.
#include <map>
#include <pah/load/load_scene.hpp>
#include <pah/scene/metal_presets.hpp>
#include <set>

#include "catch.hpp"
#include "load/yaml/suggest.hpp"
#include "scene_testing.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;

namespace {

template <class T>
T material(const std::string& yaml) {
  return std::get<T>(load("materials: {m: " + yaml + "}").scene.materials.at(0).model);
}

template <class T>
T light(const std::string& yaml) {
  return std::get<T>(load("lights: [" + yaml + "]").scene.lights.at(0).model);
}

glm::dmat4x3 transform(const std::string& steps) {
  return load("meshes: [{shape: box, transform: " + steps + "}]")
      .scene.instances.at(0)
      .world_from_object;
}

DVec3 apply(const glm::dmat4x3& m, const DVec3& p) { return m * glm::dvec4(p, 1); }

void check_near(const DVec3& a, const DVec3& b) { CHECK(glm::distance(a, b) < 1e-12); }

}  // namespace

TEST_CASE("Each file of a scene is announced before it is read, also if it is missing") {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> texts{
      {"mesh.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"a.mtl", "newmtl m\nmap_Kd named.tga\n"},
      {"sky.tga", test::tga(1, 1, "abc")},
      {"paint.tga", test::tga(1, 1, "abc")}};
  write_text(folder / "named.tga", test::tga(1, 1, "abc"));
  std::set<std::string> told;
  LoadOptions options;
  options.on_file = [&](const std::filesystem::path& file) {
    CHECK(file.parent_path() == folder.path());
    const std::string name = file.filename().string();
    told.insert(name);
    // It can still be made.
    if (const auto text = texts.find(name); text != texts.end()) write_text(file, text->second);
  };
  const std::string text =
      "textures: {paint: {type: image, file: paint.tga}}\n"
      "meshes: [{file: mesh.obj, use: [materials]}]\n"
      "lights: [{type: environment, image: sky.tga}]\n";
  const std::filesystem::path scene = write_text(folder / "scene.yaml", text);
  CHECK(load_scene(scene, options).warnings.empty());
  const std::set<std::string> all{"a.mtl", "mesh.obj", "named.tga", "paint.tga", "sky.tga"};
  CHECK(told == all);

  told.clear();
  write_text(scene,
             text + "x-more: 1\nmaterials: {m: {type: diffuse, reflectance: {image: no.tga}}}\n");
  CHECK_THROWS_AS(load_scene(scene, options), SceneError);
  CHECK(told.contains("no.tga"));
}

TEST_CASE("An empty scene has every default") {
  const Scene scene = load("x-nothing: 1\nmeshes:\n").scene;
  const auto& camera = std::get<PerspectiveCamera>(scene.camera);
  CHECK(camera.position == DVec3(0, 1, 5));
  CHECK(camera.look_at == DVec3(0));
  CHECK(camera.up == DVec3(0, 1, 0));
  CHECK(camera.fov == 45);
  CHECK(camera.aperture_radius == 0);
  CHECK_FALSE(camera.focus_distance);
  CHECK(scene.film.width == 960);
  CHECK(scene.film.height == 540);
  CHECK(scene.film.filter == PixelFilter::blackman_harris);
  CHECK(scene.film.filter_radius == 1.5);
  CHECK_FALSE(scene.film.crop);
  CHECK(scene.render.samples == 64);
  CHECK(scene.render.max_depth == 8);
  CHECK(scene.render.roulette_depth == 4);
  CHECK(scene.render.seed == 0);
  CHECK(scene.render.strategy == Strategy::mis);
  CHECK(scene.influence_areas.derive);
  CHECK(scene.acceleration.local.build.bins == 16);
  CHECK(scene.acceleration.local.heuristic == Heuristic::surface_area);
  CHECK(scene.acceleration.memory == std::nullopt);
  CHECK(scene.instances.empty());
  CHECK(scene.lights.empty());
}

TEST_CASE("Memory is a number with a unit") {
  const auto bytes = [](const std::string& size) {
    return load("acceleration: {memory: " + size + "}").scene.acceleration.memory;
  };
  CHECK(bytes("1 B") == 1);
  CHECK(bytes("3KiB") == 3072);
  CHECK(bytes("1.5 MiB") == 3 << 19);
  CHECK(bytes("2 GiB") == std::uint64_t{1} << 31);
  CHECK(bytes("\"1  tib\"") == std::uint64_t{1} << 40);
  CHECK(bytes("4 kB") == 4'000);
  CHECK(bytes("5 mb") == 5'000'000);
  CHECK(bytes("0.25 GB") == 250'000'000);
  CHECK(bytes("6 TB") == 6'000'000'000'000);
  CHECK(bytes("0.1 B") == 1);
  CHECK(bytes("99999999999999 TiB") == UINT64_MAX);
}

TEST_CASE("Every material has its defaults") {
  CHECK(material<DiffuseMaterial>("{type: diffuse}").reflectance.value == Vec3(0.8F));
  CHECK(material<MirrorMaterial>("{type: mirror}").reflectance.value == Vec3(1));
  CHECK(material<GlassMaterial>("{type: glass}").ior == 1.5F);
  CHECK(material<GlassMaterial>("{type: glass}").roughness.value == 0);
  CHECK(material<MetalMaterial>("{type: metal}").roughness.value == 0.1F);
  CHECK(material<MetalMaterial>("{type: metal}").k == Vec3(3));
  CHECK(material<PlasticMaterial>("{type: plastic}").roughness.value == 0.2F);
  CHECK(material<PrincipledMaterial>("{type: principled}").base_color.value == Vec3(0.8F));
  CHECK(load("materials: {m: {type: glass}}").scene.materials[0].opacity.value == 1);
}

TEST_CASE("Every light has its defaults") {
  CHECK(light<PointLight>("{type: point}").intensity == Vec3(1));
  CHECK(light<SpotLight>("{type: spot}").angle == 30);
  CHECK(light<SpotLight>("{type: spot}").blend == 0.15);
  CHECK(light<DirectionalLight>("{type: directional}").direction == DVec3(0, -1, 0));
  CHECK(light<DirectionalLight>("{type: directional}").angle == 0);
  CHECK_FALSE(light<AreaLight>("{type: area, shape: disk}").two_sided);
  CHECK(light<EnvironmentLight>("{type: environment}").world_from_light == DMat3(1.0));
  CHECK(light<EnvironmentLight>("{type: environment}").image == no_texture);
}

TEST_CASE("A Cornell box loads") {
  const Scene scene = load(R"(
camera:   {type: perspective, position: [0, 1, 3.4], look_at: [0, 1, 0], fov: 40}
film:     {width: 64, height: 64, filter: box, crop: [8, 16, 0, 64], channels: [albedo, depth]}
render:   {samples: 16, max_depth: 1e1, seed: 18446744073709551615}
materials:
  white: {type: diffuse, reflectance: [0.73, 0.73, 0.73]}
  red:   {type: diffuse, reflectance: "#ff8000"}
  brass: {type: metal, preset: Cu, roughness: 0.2}
meshes:
  - {name: floor, shape: rectangle, size: [2, 2], material: white}
  - {name: left, shape: rectangle, size: [2, 2], material: red, transform: [{rotate: {axis: z, angle: -90}}, {translate: [-1, 1, 0]}]}
  - {name: box, shape: box, size: [0.6, 0.6, 0.6], material: brass, transform: [{rotate: {axis: y, angle: 17}}, {translate: [0.3, 0.3, 0.3]}]}
lights:
  - {name: panel, type: area, shape: rectangle, size: [0.5, 0.5], radiance: 12, transform: [{rotate: {axis: x, angle: 180}}, {translate: [0, 1.99, 0]}]}
)")
                          .scene;
  CHECK(scene.film.filter_radius == 0.5);
  REQUIRE(scene.film.crop);
  CHECK(scene.film.crop->width() == 8);
  CHECK(scene.film.albedo);
  CHECK_FALSE(scene.film.normal);
  CHECK(scene.render.max_depth == 10);
  CHECK(scene.render.seed == 18446744073709551615U);
  REQUIRE(scene.instances.size() == 4);
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].name == "panel");
  CHECK(scene.instances[3].light == 0);
  CHECK(scene.instances[0].light == no_light);
  CHECK(std::get<AreaLight>(scene.lights[0].model).radiance == Vec3(12));
  // The left wall faces +x, exactly.
  CHECK(scene.instances[1].world_from_object[1] == DVec3(1, 0, 0));
  const auto& red = std::get<DiffuseMaterial>(scene.materials.at(1).model).reflectance.value;
  CHECK(red.x == 1);
  CHECK(red.y == Approx(0.2158605));  // sRGB 128
  const auto& brass = std::get<MetalMaterial>(scene.materials.at(2).model);
  CHECK(brass.eta == metal_presets()[2].eta);
  CHECK(std::string(metal_presets()[2].name) == "Cu");
}

TEST_CASE("Metals reflect their measured share") {
  // Returns the reflectance of a channel at normal incidence.
  const auto reflectance = [](std::size_t metal, int channel) {
    const double n = metal_presets()[metal].eta[channel], k = metal_presets()[metal].k[channel];
    return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  };
  CHECK(reflectance(0, 0) > 0.9);                           // gold: red
  CHECK(reflectance(0, 2) < 0.5);                           // hardly blue
  CHECK(reflectance(1, 1) > 0.95);                          // silver
  CHECK(reflectance(2, 0) > reflectance(2, 1));             // copper
  CHECK(reflectance(3, 1) == Approx(0.914).epsilon(0.02));  // aluminum
  CHECK(reflectance(4, 1) == Approx(0.53).epsilon(0.1));    // iron
}

TEST_CASE("Anchors, aliases and merge keys work") {
  const Scene scene = load(R"(
x-metal: &metal {type: metal, roughness: 0.3, tint: 0.5}
x-rough: &rough {roughness: 0.9, ior: 1.7}
materials:
  a: {<<: *metal, roughness: 0.4}
  b: {<<: [*rough, {type: plastic, roughness: 0.1}]}
  c: {type: plastic, <<: *rough, roughness: 0.7}
meshes:
  - &ball {shape: sphere, material: a}
  - *ball
  - {<<: *ball, material: b}
)")
                          .scene;
  CHECK(std::get<MetalMaterial>(scene.materials[0].model).roughness.value == 0.4F);
  CHECK(std::get<MetalMaterial>(scene.materials[0].model).tint.value == Vec3(0.5F));
  CHECK(std::get<PlasticMaterial>(scene.materials[1].model).roughness.value == 0.9F);
  CHECK(std::get<PlasticMaterial>(scene.materials[1].model).ior == 1.7F);
  CHECK(std::get<PlasticMaterial>(scene.materials[2].model).roughness.value == 0.7F);
  REQUIRE(scene.instances.size() == 3);
  CHECK(scene.instances[2].material == 1);
}

TEST_CASE("Transforms apply in the order written") {
  check_near(apply(transform("[{scale: 2}, {translate: [1, 0, 0]}]"), {1, 1, 1}), {3, 2, 2});
  check_near(apply(transform("[{translate: [1, 0, 0]}, {scale: [2, 1, 1]}]"), {1, 1, 1}),
             {4, 1, 1});
  check_near(apply(transform("{rotate: {axis: y, angle: 90}}"), {1, 0, 0}), {0, 0, -1});
  check_near(apply(transform("{rotate: 90}"), {1, 0, 0}), {0, 0, -1});
  check_near(apply(transform("{rotate: {axis: [0, 0, 2], angle: 45}}"), {1, 0, 0}),
             {std::sqrt(0.5), std::sqrt(0.5), 0});
  check_near(apply(transform("{matrix: [0,0,1,5, 0,1,0,6, -1,0,0,7, 0,0,0,1]}"), {1, 2, 3}),
             {8, 8, 6});
  const auto look = transform("{look_at: {from: [0, 2, 0], to: [5, 2, 0]}}");
  check_near(apply(look, {0, 0, -1}), {1, 2, 0});
  check_near(apply(look, {0, 1, 0}), {0, 3, 0});
  CHECK(transform("{rotate: {axis: x, angle: -450}}")[1] == DVec3(0, 0, -1));
}

TEST_CASE("Copies are placed by repeat and scatter") {
  const auto instances = [](const std::string& keys) {
    return load("meshes: [{shape: box, transform: {scale: 2}, " + keys + "}]").scene.instances;
  };
  const auto line = instances("repeat: {type: line, count: 3, step: [2, 0, 0]}");
  REQUIRE(line.size() == 3);
  check_near(apply(line[2].world_from_object, {1, 0, 0}), {6, 0, 0});
  const auto nested = instances(
      "repeat: [{type: line, count: 3, step: [2, 0, 0]}, {type: line, count: 2, step: [0, 9, 0], "
      "transform: {translate: [0, 0, 1]}}]");
  REQUIRE(nested.size() == 6);
  check_near(apply(nested[5].world_from_object, {0, 0, 0}), {4, 9, 1});
  CHECK(instances("repeat: {type: grid, count: [2, 3, 4]}").size() == 24);
  CHECK(instances("repeat: {type: ring, count: 5, radius: 3}").size() == 5);
  CHECK(instances("scatter: {count: 7, size: [9, 9], seed: 1}").size() == 7);
  const auto over = load(
      "meshes: [{name: lawn, shape: rectangle, size: [4, 4], transform: {translate: [0, 3, 0]}}, "
      "{shape: box, scatter: {count: 9, over: lawn}}]");
  REQUIRE(over.scene.instances.size() == 10);
  for (std::size_t i = 1; i < 10; ++i)
    CHECK(over.scene.instances[i].world_from_object[3].y == Approx(3));
  CHECK(over.scene.meshes.size() == 2);
}

TEST_CASE("A mesh file without a material is gray, whatever materials the scene has") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* text :
       {"meshes: [{file: a.obj}]", "materials: {m: {type: mirror}}\nmeshes: [{file: a.obj}]",
        "meshes: [{file: a.obj, use: [materials]}]"}) {
    CAPTURE(text);
    const Scene scene = load_scene(write_text(folder / "scene.yaml", text)).scene;
    REQUIRE(scene.instances.size() == 1);
    REQUIRE(scene.instances[0].material < scene.materials.size());
    const auto& model = scene.materials[scene.instances[0].material].model;
    REQUIRE(std::holds_alternative<DiffuseMaterial>(model));
    CHECK(std::get<DiffuseMaterial>(model).reflectance.value == Vec3(0.8F));
  }
}

TEST_CASE("Textures may replace colors and numbers") {
  const TemporaryFolder folder;
  write_text(folder / "picture.tga", test::tga(2, 2, "twelve bytes"));
  const Scene scene = load_scene(write_text(folder / "scene.yaml", R"(
textures:
  wood: {type: image, file: picture.tga, scale: 3, offset: [0, 0.5], wrap: clamp}
materials:
  a: {type: plastic, reflectance: {texture: wood, scale: 0.5}, roughness: {texture: wood, channel: g, scale: 0.25}}
  b: {type: diffuse, reflectance: {image: picture.tga}, normal_map: {image: picture.tga}}
  c: {type: diffuse, reflectance: {image: picture.tga}, opacity: {image: picture.tga, channel: a}}
)"))
                          .scene;
  const auto& a = std::get<PlasticMaterial>(scene.materials[0].model);
  CHECK(a.reflectance.texture == 0);
  CHECK(a.reflectance.value == Vec3(0.5F));
  CHECK(a.roughness.channel == 1);
  CHECK(a.roughness.value == 0.25F);
  const auto image = [&](TextureId id) { return std::get<ImageTexture>(scene.textures.at(id)); };
  CHECK(image(0).scale == DVec2(3));
  CHECK(image(0).clamp);
  CHECK(image(0).color_space == ColorSpace::automatic);
  // Used as numbers, the same picture is linear.
  CHECK(image(a.roughness.texture).color_space == ColorSpace::linear);
  CHECK(image(a.roughness.texture).scale == DVec2(3));
  CHECK(image(scene.materials[1].normal_map).color_space == ColorSpace::linear);
  CHECK(scene.materials[2].opacity.texture == scene.materials[1].normal_map);
  CHECK(std::get<DiffuseMaterial>(scene.materials[1].model).reflectance.texture ==
        std::get<DiffuseMaterial>(scene.materials[2].model).reflectance.texture);
  CHECK(scene.textures.size() == 4);
  LoadOptions options;
  options.limits.image_bytes = 47;
  CHECK_THROWS_AS(load_scene(folder / "scene.yaml", options), SceneError);
}

TEST_CASE("Influence areas are read") {
  const auto settings = [](const std::string& areas) {
    return load(
               "lights: [{name: bulb, type: point}, {name: sun, type: directional}]\n"
               "influence_areas: " +
               areas)
        .scene.influence_areas;
  };
  CHECK(settings("auto").derive);
  CHECK_FALSE(settings("off").derive);
  const InfluenceSettings both = settings(
      "[auto, {type: point, light: bulb, forward: [0, -1, 0], fov: [90, 80], near: 0, far: 10}, "
      "{type: plane, light: sun, position: [0, 8, 0], direction: [-1, -2, -1], size: [12, 10], "
      "depth: 16}, {type: point, light: camera}]");
  CHECK(both.derive);
  REQUIRE(both.declared.size() == 3);
  CHECK(std::get<PointAreaDeclaration>(both.declared[0]).fov == DVec2(90, 80));
  CHECK(std::get<PlaneAreaDeclaration>(both.declared[1]).depth == 16);
  CHECK(std::get<PointAreaDeclaration>(both.declared[2]).light == "camera");
  CHECK_FALSE(settings("[{type: point, light: bulb}]").derive);
}

TEST_CASE("Overrides apply before reading") {
  const char* text = R"(
render: &r {samples: 4, max_depth: 3}
x-other: *r
materials: {white: {type: diffuse}, wall.001: {type: mirror}}
meshes: [{name: floor, shape: box}, {name: ball, shape: sphere, material: white}]
)";
  const auto with = [&](std::vector<std::string> overrides) {
    return load(text, {std::move(overrides), {}}).scene;
  };
  CHECK(with({"render.samples=9"}).render.samples == 9);
  CHECK(with({"render.samples=9"}).render.max_depth == 3);
  CHECK(with({"render={seed: 5}"}).render.samples == 64);
  CHECK(with({"film.width=32", "film.width=33"}).film.width == 33);
  CHECK(with({"meshes.floor.material=white"}).instances[0].material == 0);
  CHECK(with({"meshes.1.material=wall.001"}).instances[1].material == 1);
  CHECK(with({"materials.wall.001.reflectance=0.5"}).materials[1].name == "wall.001");
  CHECK(with({"influence_areas=off"}).influence_areas.derive == false);
  CHECK(with({"camera.position=[1, 2, 3]"}).meshes.size() == 2);
  const auto errors = [&](std::string one) { return errors_of(text, {{std::move(one)}, {}}); };
  CHECK(errors("render.samples=abc") ==
        "-D render.samples=abc: error: 'samples' of render must be a whole number, not 'abc'\n");
  CHECK(errors("render.sampels=4") ==
        "-D render.sampels=4: error: unknown key 'sampels' in render; did you mean 'samples'?\n");
  CHECK(errors("meshes.flor.material=white") ==
        "-D meshes.flor.material=white: error: no element 'flor' in a list of 2; did you mean "
        "'floor'?\n");
  CHECK(errors("meshes.7.material=white") ==
        "-D meshes.7.material=white: error: no element '7' in a list of 2\n");
  CHECK(errors("render.samples.x=1") ==
        "-D render.samples.x=1: error: 'x' is sought in '4', which is neither a map nor a list\n");
  CHECK(errors("render") == "-D render: error: an override is key.path=value\n");
  CHECK(errors("=3") == "-D =3: error: an override is key.path=value\n");
  CHECK(errors("render.samples=[1") ==
        "-D render.samples=[1: error: a key must be text, not a list or map; is a bracket left "
        "open?\n");
  CHECK(errors("a" + std::string(100'000, '.') + "b=1").find("more than 64 steps") !=
        std::string::npos);
}

TEST_CASE("The edit distance counts insertions, deletions, substitutions and swaps") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "abc") == 0);
  CHECK(edit_distance("radiance", "raidance") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ca", "abc") == 3);  // the restricted distance
}
