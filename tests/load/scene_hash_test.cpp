// The hash of a scene and of its files.
#include <tbb/task_arena.h>

#include <pah/load/load_scene.hpp>
#include <set>

#include "catch.hpp"
#include "load/scene/files/files.hpp"
#include "scene_testing.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;

TEST_CASE("The hash tells scenes apart, and knows the files") {
  const TemporaryFolder folder;
  write_text(folder / "a.tga", test::tga(1, 1, "abc"));
  const auto file =
      write_text(folder / "scene.yaml", "textures: {t: {type: image, file: a.tga}}\n");
  const std::string hash = load_scene(file).hash;
  CHECK(hash.size() == 32);
  CHECK(load_scene(file).hash == hash);
  CHECK(load_scene(file, {{"render.seed=1"}, {}}).hash != hash);
  write_text(folder / "a.tga", test::tga(1, 1, "abd"));
  CHECK(load_scene(file).hash != hash);
  CHECK(load("render: {seed: 1}").hash != load("render: {seed: 2}").hash);
}

TEST_CASE("The hash knows every block of a large file, whatever the threads") {
  const TemporaryFolder folder;
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  while (obj.size() < 2'500'000) obj += "# a comment\n";
  const auto file = write_text(folder / "scene.yaml", "meshes: [{file: a.obj}]\n");
  const auto hash_of = [&](const std::string& text) {
    write_text(folder / "a.obj", text);
    return load_scene(file).hash;
  };
  const std::string hash = hash_of(obj);
  tbb::task_arena(1).execute([&] { CHECK(load_scene(file).hash == hash); });
  for (const std::size_t near : {500'000UL, 1'500'000UL, 2'499'000UL}) {
    std::string other = obj;
    other[obj.find("comment", near)] = 'C';
    CHECK(hash_of(other) != hash);
  }
  CHECK(hash_of(obj + "#\n") != hash);
  CHECK(hash_of(obj) == hash);
}

TEST_CASE("The hash is FNV-1a of 128 bits") {
  ContentHash empty, word;
  CHECK(empty.hex() == "6c62272e07bb014262b821756295c58d");
  word.add("foobar");
  CHECK(word.hex() == "343e1662793c64bf6f0d3597ba446f18");
}
