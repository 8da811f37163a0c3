// LoadedFiles keeps a scene's files for the next load.
#include <pah/load/loaded_files.hpp>
#include <set>

#include "catch.hpp"
#include "scene_testing.hpp"
#include "support/picture_bytes.hpp"

using namespace pah;

namespace {

namespace fs = std::filesystem;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string other_triangle = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";

// Replaces the text by one of the same size and restores the old time, so that the change is not
// noticed.
void replace_unnoticed(const fs::path& file, const std::string& text) {
  REQUIRE(fs::file_size(file) == text.size());
  const fs::file_time_type time = fs::last_write_time(file);
  write_text(file, text);
  fs::last_write_time(file, time);
}

void replace_noticed(const fs::path& file, const std::string& text) {
  const fs::file_time_type time = fs::last_write_time(file);
  write_text(file, text);
  fs::last_write_time(file, time + std::chrono::milliseconds(1));
}

class Loads {
 public:
  explicit Loads(const std::string& scene) : file_(write_text(folder_ / "scene.yaml", scene)) {}

  [[nodiscard]] fs::path operator/(const char* name) const { return folder_ / name; }
  LoadedScene load() {
    named_.clear();
    return load_scene(file_, {{}, {}, [&](const fs::path& f) { named_.insert(f); }, &loaded_});
  }
  std::string errors() { return errors_in(file_, {{}, {}, {}, &loaded_}); }
  [[nodiscard]] const std::set<fs::path>& named() const { return named_; }

 private:
  TemporaryFolder folder_;
  fs::path file_;
  LoadedFiles loaded_;
  std::set<fs::path> named_;
};

float width(const LoadedScene& loaded) { return loaded.scene.meshes.at(0).positions.at(1).x; }

}  // namespace

TEST_CASE("A mesh is read again only if it changed") {
  Loads loads("meshes: [{file: a.obj}]");
  write_text(loads / "a.obj", triangle);
  const LoadedScene first = loads.load();
  CHECK(width(first) == 1);
  replace_unnoticed(loads / "a.obj", other_triangle);
  const LoadedScene second = loads.load();
  CHECK(width(second) == 1);
  CHECK(second.hash == first.hash);
  CHECK(second.scene.instances.size() == 1);
  CHECK(loads.named() == std::set<fs::path>{loads / "a.obj"});
  replace_noticed(loads / "a.obj", other_triangle);
  const LoadedScene third = loads.load();
  CHECK(width(third) == 2);
  CHECK(third.hash != first.hash);
  fs::remove(loads / "a.obj");
  CHECK(loads.errors().find("does not exist") != std::string::npos);
}

TEST_CASE("A mesh is read again when a file that it names changes") {
  Loads loads("meshes: [{file: a.obj, use: [materials]}]");
  write_text(loads / "a.obj", "mtllib a.mtl\n" + triangle.substr(0, 24) + "usemtl m\nf 1 2 3\n");
  write_text(loads / "a.mtl", "newmtl m\nKd 0.5 0.5 0.5\n");
  const LoadedScene first = loads.load();
  CHECK(loads.named() == std::set<fs::path>{loads / "a.obj", loads / "a.mtl"});
  CHECK(loads.load().hash == first.hash);
  CHECK(loads.named() == std::set<fs::path>{loads / "a.obj", loads / "a.mtl"});
  replace_noticed(loads / "a.mtl", "newmtl m\nKd 0.6 0.6 0.6\n");
  const LoadedScene second = loads.load();
  CHECK(second.hash != first.hash);
  CHECK(std::get<DiffuseMaterial>(
            second.scene.materials.at(second.scene.instances.at(0).material).model)
            .reflectance.value.x == 0.6F);
  fs::remove(loads / "a.mtl");
  CHECK_FALSE(loads.load().warnings.empty());
}

TEST_CASE("A mesh is kept for each way to read it") {
  Loads loads("meshes: [{file: a.obj, normals: smooth}, {file: a.obj, normals: flat}]");
  write_text(loads / "a.obj", triangle);
  for (int i = 0; i < 2; ++i) {
    const LoadedScene loaded = loads.load();
    REQUIRE(loaded.scene.meshes.size() == 2);
    CHECK(loaded.scene.meshes[0].normals.size() == 3);
    CHECK(loaded.scene.meshes[1].normals.empty());
  }
}

TEST_CASE("A picture is checked again only if it changed") {
  Loads loads("textures: {t: {type: image, file: a.tga}}");
  const std::string whole = test::tga(2, 2, "twelve bytes");
  write_text(loads / "a.tga", whole);
  const std::string hash = loads.load().hash;
  replace_unnoticed(loads / "a.tga", std::string(whole.size(), 'x'));
  CHECK(loads.load().hash == hash);
  replace_noticed(loads / "a.tga", std::string(whole.size(), 'x'));
  CHECK(loads.errors().find("cannot read image 'a.tga'") != std::string::npos);
  CHECK(loads.errors().find("cannot read image 'a.tga'") != std::string::npos);
}

TEST_CASE("Files that a scene no longer names are not kept") {
  Loads loads("meshes: [{file: a.obj}]");
  write_text(loads / "a.obj", triangle);
  (void)loads.load();
  write_text(loads / "scene.yaml", "meshes: [{shape: box}]");
  (void)loads.load();
  replace_unnoticed(loads / "a.obj", other_triangle);
  write_text(loads / "scene.yaml", "meshes: [{file: a.obj}]");
  CHECK(width(loads.load()) == 2);
}
