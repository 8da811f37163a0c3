#include "generated_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <pah/scene/placement.hpp>
#include <pah/scene/shapes.hpp>
#include <random>

namespace pah::bench {
namespace {

using Places = std::vector<glm::dmat4x3>;

glm::dmat4x3 moved(const DVec3& by) { return {DVec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }

// Takes +y to `up` and +z to `front`, which are perpendicular and of unit length.
glm::dmat4x3 turned(const DVec3& up, const DVec3& front, const DVec3& position) {
  return {glm::cross(up, front), up, front, position};
}

MaterialId add_material(Scene& scene, const Vec3& reflectance) {
  Material material;
  material.model = DiffuseMaterial{{reflectance}};
  scene.materials.push_back(material);
  return static_cast<MaterialId>(scene.materials.size() - 1);
}

void add(Scene& scene, Mesh mesh, MaterialId material, const Places& places) {
  const auto id = static_cast<MeshId>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  for (const glm::dmat4x3& place : places)
    scene.instances.push_back({id, material, no_light, place});
}

void append(Mesh& mesh, const Mesh& part, const glm::dmat4x3& place) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& position : part.positions)
    mesh.positions.emplace_back(place * glm::dvec4(DVec3(position), 1));
  for (const UVec3& triangle : part.triangles) mesh.triangles.push_back(triangle + first);
}

int whole(double x, int least) { return std::max(least, static_cast<int>(std::lround(x))); }

// A sheet of about so many triangles in squares. `height_at` takes x and z.
template <typename HeightAt>
Mesh relief(const DVec2& size, double triangles, const HeightAt& height_at) {
  HeightFieldShape shape;
  shape.size = size;
  shape.columns = whole(std::sqrt(triangles / 2 * size.x / size.y), 1) + 1;
  shape.rows = whole(triangles / 2 / (shape.columns - 1), 1) + 1;
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const double x = size.x * (double(column) / (shape.columns - 1) - 0.5);
      const double z = size.y * (double(row) / (shape.rows - 1) - 0.5);
      shape.heights.push_back(static_cast<float>(height_at(x, z)));
    }
  }
  Mesh mesh = make_mesh(shape);
  mesh.normals.clear();  // edges are to be seen
  return mesh;
}

// 1 in the middle of every square of a pattern, 0 in the frames about them.
double inside_frame(double x, double z, double side) {
  const auto inside = [&](double at) {
    const double share = at / side - std::floor(at / side);
    return share > 0.25 && share < 0.75;
  };
  return inside(x) && inside(z) ? 1 : 0;
}

Mesh sphere(double radius, double triangles) {
  const int segments = whole(std::sqrt(triangles), 4);
  return make_mesh(SphereShape{radius, segments, whole(segments / 2.0, 2) + 1});
}

Mesh torus(double radius, double tube_radius, double triangles) {
  const int segments = whole(std::sqrt(triangles), 4);
  return make_mesh(TorusShape{radius, tube_radius, segments, whole(segments / 2.0, 3)});
}

Scene scene_seen_by(const PerspectiveCamera& camera, const PointLight& bulb,
                    const DirectionalLight& sun, const SpotLight& spot) {
  Scene scene;
  scene.camera = camera;
  scene.film.width = scene.film.height = 128;
  scene.render.max_depth = 4;
  scene.lights = {{"bulb", bulb}, {"sun", sun}, {"spot", spot}};
  return scene;
}

// A tapered trunk with boughs.
Mesh wood(int segments) {
  constexpr int boughs = 12;
  Mesh mesh;
  append(mesh, make_mesh(ConeShape{0.2, 5, 2 * segments, false}), moved({0, 2.5, 0}));
  const Mesh bough = make_mesh(ConeShape{0.06, 1.4, segments, false});
  for (int i = 0; i < boughs; ++i) {
    const double angle = 2.4 * i;
    const DVec3 along = glm::normalize(DVec3{std::cos(angle), 0.6, std::sin(angle)});
    const DVec3 foot{0, 1.8 + 0.2 * i, 0};
    append(mesh, bough,
           turned(along, glm::normalize(glm::cross(along, {0, 1, 0})), foot + 0.7 * along));
  }
  return mesh;
}

// Leaves of two triangles that fill a crown, the denser the farther out. Their area is the same
// however many they are.
Mesh foliage(std::size_t leaves, std::mt19937& random) {
  constexpr double area = 24;  // of all leaves of a tree
  const DVec3 center{0, 3.7, 0};
  const DVec3 radii{1.5, 1.8, 1.5};
  const double reach = std::sqrt(area / static_cast<double>(leaves));
  const auto draw = [&] { return static_cast<double>(random()) * 0x1p-32; };
  const auto direction = [&] {
    const double y = 2 * draw() - 1;
    const double angle = 2 * std::numbers::pi * draw();
    const double around = std::sqrt(1 - y * y);
    return DVec3{around * std::cos(angle), y, around * std::sin(angle)};
  };
  Mesh mesh;
  for (std::size_t i = 0; i < leaves; ++i) {
    const DVec3 at = center + radii * direction() * std::pow(draw(), 0.25);
    const DVec3 length = reach * direction();
    const DVec3 width = 0.5 * glm::cross(length, direction());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const DVec3& corner : {at - length, at + width, at + length, at - width})
      mesh.positions.emplace_back(corner);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  return mesh;
}

Scene forest(double triangles) {
  Scene scene = scene_seen_by({{5, 9, 36}, {0, 2, 2}, {0, 1, 0}, 50, 0, {}},
                              {{3, 6.5, 10}, Vec3{200}}, {{-1, -1.6, -0.7}, Vec3{3}, 0},
                              {{-14, 15, 14}, {14, -13, -14}, Vec3{1500}, 30, 0.15});
  const MaterialId soil = add_material(scene, {0.25F, 0.2F, 0.12F});
  const MaterialId bark = add_material(scene, {0.3F, 0.2F, 0.13F});

  const Mesh ground = relief({50, 50}, 0.02 * triangles, [](double x, double z) {
    return 0.8 * std::sin(0.2 * x) * std::cos(0.25 * z);
  });
  add(scene, ground, soil, {moved({0, 0, 0})});

  ScatterOptions options;
  options.count = static_cast<std::uint32_t>(whole(100 * std::pow(1e-5 * triangles, 0.35), 1));
  options.seed = 5;
  options.scale = {0.7, 1.3};
  options.min_distance = 1;
  const Places trees = scatter(ground, moved({0, 0, 0}), options);
  const double of_a_tree = 0.98 * triangles / static_cast<double>(trees.size());
  const Mesh trunk = wood(whole(0.15 * of_a_tree / 14, 3));
  const auto leaves =
      static_cast<std::size_t>((of_a_tree - static_cast<double>(trunk.triangles.size())) / 2);
  add(scene, trunk, bark, trees);

  constexpr std::size_t kinds = 4;
  std::mt19937 random(7);
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    Places places;
    for (std::size_t i = kind; i < trees.size(); i += kinds) places.push_back(trees[i]);
    const auto shade = static_cast<float>(kind);
    add(scene, foliage(leaves, random), add_material(scene, {0.1F + 0.06F * shade, 0.4F, 0.1F}),
        places);
  }
  return scene;
}

// Swollen and fluted, about y.
Mesh shaft(double height, double triangles) {
  constexpr double flutes = 16;
  const auto segments =
      static_cast<std::uint32_t>(8 * whole(std::sqrt(triangles / (2 * height)) / 8, 1));
  const auto rings = static_cast<std::uint32_t>(whole(triangles / (2 * segments), 1));
  Mesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const double up = double(ring) / rings;
    for (std::uint32_t segment = 0; segment < segments; ++segment) {
      const double angle = 2 * std::numbers::pi * segment / segments;
      const double radius = 0.5 - 0.1 * up * up + 0.02 * std::cos(flutes * angle);
      mesh.positions.emplace_back(radius * std::cos(angle), height * up, radius * std::sin(angle));
    }
  }
  for (std::uint32_t i = 0; i < rings * segments; ++i) {
    const std::uint32_t next = i % segments + 1 < segments ? i + 1 : i + 1 - segments;
    mesh.triangles.emplace_back(i, i + segments, next);
    mesh.triangles.emplace_back(next, i + segments, next + segments);
  }
  return mesh;
}

void add_columns(Scene& scene, const Places& places, double triangles) {
  const MaterialId marble = add_material(scene, {0.8F, 0.77F, 0.7F});
  const double each = triangles / static_cast<double>(places.size());
  const Mesh slab = make_mesh(BoxShape{{1.5, 0.3, 1.5}});
  const Mesh ring = torus(0.5, 0.14, 0.13 * each);
  Mesh column;
  append(column, slab, moved({0, 0.15, 0}));
  append(column, ring, moved({0, 0.42, 0}));
  append(column, ring, moved({0, 0.62, 0}));
  append(column, shaft(6, 0.6 * each), moved({0, 0.5, 0}));
  append(column, ring, moved({0, 6.55, 0}));
  append(column, slab, moved({0, 6.85, 0}));
  add(scene, std::move(column), marble, places);
}

// A ceiling with an opening of 16 x 8 m in its middle.
void add_ceiling(Scene& scene, double height, double triangles) {
  const MaterialId plaster = add_material(scene, {0.75F, 0.7F, 0.62F});
  const auto coffers = [](double x, double z) { return -0.25 * inside_frame(x, z, 2); };
  const auto panel = [&](const DVec2& size, const DVec2& at) {
    const double share = size.x * size.y / (40 * 24 - 16 * 8);
    add(scene, relief(size, share * triangles, coffers), plaster,
        {turned({0, -1, 0}, {0, 0, 1}, {at.x, height, at.y})});
  };
  panel({12, 24}, {-14, 0});
  panel({12, 24}, {14, 0});
  panel({16, 8}, {0, -8});
  panel({16, 8}, {0, 8});
}

void add_walls(Scene& scene, double height, double triangles) {
  const MaterialId brick = add_material(scene, {0.65F, 0.45F, 0.35F});
  const auto niches = [](double x, double z) { return -0.15 * inside_frame(x, z, 3.5); };
  const DVec3 down{0, -1, 0};
  const double middle = height / 2;
  add(scene, relief({40, height}, 0.31 * triangles, niches), brick,
      {turned({0, 0, 1}, down, {0, middle, -12}), turned({0, 0, -1}, down, {0, middle, 12})});
  add(scene, relief({24, height}, 0.19 * triangles, niches), brick,
      {turned({1, 0, 0}, down, {-20, middle, 0}), turned({-1, 0, 0}, down, {20, middle, 0})});
}

Scene hall(double triangles) {
  Scene scene = scene_seen_by({{-19.4, 3.2, 4}, {0, 2.9, -0.5}, {0, 1, 0}, 62, 0, {}},
                              {{1, 4.5, 0}, Vec3{60}}, {{-0.5, -1.6, -0.5}, Vec3{2.5}, 0},
                              {{-12, 6.5, 4.2}, {16, -6, -5}, Vec3{250}, 40, 0.15});
  constexpr double height = 7;
  const MaterialId stone = add_material(scene, {0.5F, 0.5F, 0.52F});
  const auto tiles = [](double x, double z) { return 0.01 * inside_frame(x, z, 1); };
  add(scene, relief({40, 24}, 0.03 * triangles, tiles), stone, {moved({0, 0, 0})});
  add_ceiling(scene, height, 0.07 * triangles);
  add_walls(scene, height, 0.05 * triangles);

  Places columns = place(GridRepeat{{10, 1, 6}, {4, 1, 4}, true});
  std::erase_if(columns, [](const glm::dmat4x3& at) {
    return std::abs(at[3].x) < 8 && std::abs(at[3].z) < 4;
  });
  add_columns(scene, columns, 0.82 * triangles);

  const MaterialId bronze = add_material(scene, {0.4F, 0.3F, 0.15F});
  add(scene, sphere(0.8, 0.015 * triangles), bronze, {moved({0, 1.2, 0})});
  add(scene, torus(1.8, 0.3, 0.015 * triangles), bronze, {moved({0, 0.3, 0})});
  return scene;
}

constexpr int blocks = 4;       // in a row
constexpr double pitch = 16;    // of blocks, meters
constexpr double building = 9;  // its side

double height_of(int x, int z) {
  constexpr std::array<double, 4> heights{5, 7, 10, 13};
  return heights[static_cast<std::size_t>(3 * x + 5 * z + x * z) % heights.size()];
}

void add_buildings(Scene& scene, double triangles) {
  double all_heights = 0;
  for (int i = 0; i < blocks * blocks; ++i) all_heights += height_of(i % blocks, i / blocks);
  const auto windows = [](double x, double z) { return -0.2 * inside_frame(x, z, 2.25); };
  const DVec3 down{0, -1, 0};
  for (int i = 0; i < blocks * blocks; ++i) {
    const int x = i % blocks;
    const int z = i / blocks;
    const double height = height_of(x, z);
    constexpr double middle = 0.5 * (blocks - 1);
    const DVec3 center{pitch * (x - middle), height / 2, pitch * (z - middle)};
    const auto shade = 0.1F * static_cast<float>(i % 3);
    const MaterialId wall = add_material(scene, {0.7F, 0.65F - shade, 0.6F - 2 * shade});
    // Walls stand before the windows' depth.
    add(scene, make_mesh(BoxShape{{building - 0.5, height, building - 0.5}}), wall,
        {moved(center)});
    Places sides;
    for (const DVec3& out : {DVec3{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}})
      sides.push_back(turned(out, down, center + 0.5 * building * out));
    add(scene, relief({building, height}, triangles * height / (4 * all_heights), windows), wall,
        sides);
  }
}

// Bodies scattered over the streets.
void add_crowd(Scene& scene, double triangles) {
  Mesh streets;
  const Mesh strip = make_mesh(RectangleShape{{blocks * pitch, 4.5}});
  for (int i = 0; i <= blocks; ++i) {
    const double at = pitch * (i - 0.5 * blocks);
    append(streets, strip, moved({0, 0, at}));
    append(streets, strip, turned({0, 1, 0}, {1, 0, 0}, {at, 0, 0}));
  }
  ScatterOptions options;
  options.count = static_cast<std::uint32_t>(whole(350 * std::pow(1e-5 * triangles, 0.4), 1));
  options.seed = 3;
  options.scale = {0.6, 1.4};
  options.min_distance = 0.6;
  const Places crowd = scatter(streets, moved({0, 0, 0}), options);
  const double each = triangles / static_cast<double>(crowd.size());
  const std::array<Mesh, 3> bodies{sphere(0.5, each), torus(0.45, 0.16, each),
                                   make_mesh(CylinderShape{0.3, 1.4, whole(each / 4, 3)})};
  const std::array<Vec3, 3> colors{
      Vec3{0.8F, 0.2F, 0.15F}, {0.2F, 0.45F, 0.8F}, {0.8F, 0.7F, 0.2F}};
  for (std::size_t kind = 0; kind < bodies.size(); ++kind) {
    Places places;
    for (std::size_t i = kind; i < crowd.size(); i += bodies.size())
      places.push_back(compose(crowd[i], moved({0, 0.7, 0})));
    add(scene, bodies[kind], add_material(scene, colors[kind]), places);
  }
}

Scene city(double triangles) {
  Scene scene = scene_seen_by({{9, 38, 58}, {0, 1, 4}, {0, 1, 0}, 46, 0, {}},
                              {{0, 5, 16}, Vec3{100}}, {{-1, -1.5, -0.6}, Vec3{3}, 0},
                              {{0, 18, 38}, {0, -18, -30}, Vec3{1500}, 35, 0.15});
  add(scene, make_mesh(RectangleShape{{80, 80}}), add_material(scene, {0.3F, 0.3F, 0.3F}),
      {moved({0, 0, 0})});
  add_buildings(scene, 0.5 * triangles);
  add_crowd(scene, 0.5 * triangles);
  return scene;
}

struct Kind {
  const char* name;
  Scene (*make)(double triangles);
};

constexpr std::array<Kind, 3> kinds{{{"forest", forest}, {"hall", hall}, {"city", city}}};

const Kind* kind_of(const std::string& name) {
  const std::string kind = name.substr(0, name.find('_'));
  const auto* const found = std::ranges::find(kinds, kind, &Kind::name);
  return found != kinds.end() ? found : nullptr;
}

}  // namespace

bool is_generated(const std::string& name) { return kind_of(name) != nullptr; }

bool large_scenes() { return std::getenv("PAHRENDER_LARGE") != nullptr; }

std::vector<std::string> generated_scene_names() {
  std::vector<std::string> sizes{"100k", "1m"};
  if (large_scenes()) sizes.emplace_back("5m");
  std::vector<std::string> names;
  for (const Kind& kind : kinds)
    for (const std::string& size : sizes) names.push_back(std::string(kind.name) + "_" + size);
  return names;
}

Scene generated_scene(const std::string& name) {
  const double number = std::stod(name.substr(name.find('_') + 1));
  return kind_of(name)->make(number * (name.back() == 'm' ? 1e6 : 1e3));
}

}  // namespace pah::bench
