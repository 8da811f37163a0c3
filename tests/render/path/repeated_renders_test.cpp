// Tests repeated renders in one process, as in programs that embed the library.
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/render/film_file.hpp>
#include <pah/render/render.hpp>
#include <pah/render/session.hpp>

#include "catch.hpp"
#include "support/fewer.hpp"
#include "support/picture_bytes.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;

namespace {

void write(const char* file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Loads a file, renders it, and continues the film in a second session.
Film load_and_render() {
  const LoadedScene loaded = load_scene("scene.yaml");
  const Scene& scene = loaded.scene;
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  const RenderResult first = render(world, *acceleration.accelerator, scene.film, scene.render);
  write_film("a.film", {"1", loaded.hash, scene.film, scene.render}, first.held, first.film);
  RenderSession session(world, *acceleration.accelerator, scene.film, scene.render);
  session.restore(read_film("a.film").film);
  std::vector<std::size_t> tiles(session.tiles().size());
  std::iota(tiles.begin(), tiles.end(), std::size_t{0});
  session.render_pass(tiles, first.samples, 1);
  return std::move(session).take_film();
}

std::size_t allocated() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

void check_memory_of(int renders) {
  const CurrentTemporaryFolder folder;
  write("paint.tga", test::tga(2, 2, "abcdefghijkl"));
  write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  write("scene.yaml",
        "camera: {position: [0.3, 0.3, 2], look_at: [0.3, 0.3, 0]}\n"
        "film: {width: 8, height: 8, channels: [albedo, normal, depth]}\n"
        "render: {samples: 1, max_depth: 3}\n"
        "materials: {paint: {type: diffuse, reflectance: {image: paint.tga}}}\n"
        "meshes: [{file: mesh.obj, material: paint}]\n"
        "lights: [{type: environment}, {type: point, position: [1, 1, 1]}]\n");
  std::size_t film_bytes = 0;
  for (int i = 0; i < renders / 5; ++i) film_bytes = load_and_render().bytes();
  const std::size_t before = allocated();
  const int measured = renders - renders / 5;
  for (int i = 0; i < measured; ++i) (void)load_and_render();
  // A leak in every render must stay below a sixteenth of a film, which is half a kilobyte. The
  // memory that allocators and threads keep grows by less.
  const auto growth = static_cast<double>(allocated()) - static_cast<double>(before);
  CAPTURE(before, film_bytes, growth);
  CHECK(growth < measured * static_cast<double>(film_bytes) / 16);
}

}  // namespace

// Sanitizers have allocators of their own, and look for leaks themselves.
TEST_CASE("Renders in one process do not let memory grow") {
  if (!test::sanitized) check_memory_of(75);
}
TEST_CASE("Five hundred renders in one process do not let memory grow", "[full]") {
  if (!test::sanitized) check_memory_of(500);
}
