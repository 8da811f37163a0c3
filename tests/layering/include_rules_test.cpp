#include <fstream>
#include <map>

#include "catch.hpp"
#include "include_rules.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using pah::test::broken_include_rules;

namespace {

// A tree of source files for a test.
class Tree {
 public:
  explicit Tree(const std::map<std::string, std::string>& files) {
    for (const auto& [name, text] : files) {
      fs::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name) << text;
    }
  }

  [[nodiscard]] const fs::path& root() const { return folder_.path(); }

 private:
  pah::TemporaryFolder folder_;
};

std::vector<std::string> faults_of(const std::string& file, const std::string& text) {
  const Tree tree(std::map<std::string, std::string>{{file, text}});
  return broken_include_rules(tree.root());
}

}  // namespace

TEST_CASE("Every module includes only modules below it") {
  const fs::path root = pah::test::source_folder();
  REQUIRE(fs::exists(root / "src" / "cli" / "main.cpp"));
  std::string all;
  for (const std::string& fault : broken_include_rules(root)) all += fault + "\n";
  INFO(all);
  CHECK(all.empty());
}

TEST_CASE("Allowed includes pass") {
  const Tree tree({
      {"include/pah/bvh/bvh.hpp", "#include <pah/geometry/aabb.hpp>\n#include <glm/vec3.hpp>\n"},
      {"include/pah/render/session.hpp", "#include <pah/render/film.hpp>\n"},
      {"src/bvh/bvh.cpp",
       "#include \"bvh/bvh.hpp\"\n#include \"near.hpp\"\n"
       "#include \"base/parallel_for.hpp\"\n"
       "// #include <CGAL/box.h> in a comment\n"},
      {"src/image/texture/store.cpp",
       "#include <OpenImageIO/texture.h>\n#include \"image/srgb.hpp\"\n"},
      {"src/base/parallel_for.cpp", "#include <tbb/parallel_for.h>\n"},
      {"src/render/film/film_file.cpp",
       "#include <pah/render/film_file.hpp>\n#include <fmt/format.h>\n"
       "#include \"base/output_file.hpp\"\n"},
      {"src/render/path/session.cpp",
       "#include <pah/render/session.hpp>\n#include \"render/light/lights.hpp\"\n"},
      {"src/load/yaml/tree.cpp",
       "#include \"load/yaml/tree.hpp\"\n#include <yaml-cpp/yaml.h>\n"
       "#include <pah/base/errors.hpp>\n#include <pah/geometry/vec.hpp>\n"},
      {"src/load/mesh/mesh_file.cpp",
       "#include <pah/load/mesh_file.hpp>\n#include <fmt/format.h>\n"
       "#include \"load/mesh/gltf/gltf.hpp\"\n#include <pah/scene/camera.hpp>\n"},
      {"src/load/scene/load_scene.cpp",
       "#include <pah/load/load_scene.hpp>\n#include <pah/load/mesh_file.hpp>\n"
       "#include \"load/yaml/tree.hpp\"\n#include \"load/scene/sections/reading.hpp\"\n"
       "#include \"image/texture/store.hpp\"\n"},
      {"src/report/study/study.cpp",
       "#include \"report/json.hpp\"\n#include \"base/output_file.hpp\"\n"},
      {"src/cli/main.cpp",
       "#include <CLI/CLI.hpp>\n#include <unistd.h>\n#include \"report/stats.hpp\"\n"
       "#include \"cli/render/frames.hpp\"\n"},
  });
  CHECK(broken_include_rules(tree.root()).empty());
}

namespace {

struct PlantedFault {
  const char* file;
  const char* include;
  const char* message = nullptr;  // if given, all that follows the line's number
};

void must_be_found(const std::vector<PlantedFault>& plants) {
  for (const PlantedFault& plant : plants) {
    INFO(plant.file << ": " << plant.include);
    const auto faults = faults_of(plant.file, "#include " + std::string(plant.include) + "\n");
    REQUIRE(faults.size() == 1);
    if (plant.message != nullptr)
      CHECK(faults[0] == plant.file + std::string(":1: ") + plant.message);
  }
}

}  // namespace

TEST_CASE("Planted faults are found, with their place") {
  using Faults = std::vector<std::string>;
  SECTION("the line of an include after others") {
    CHECK(faults_of("src/bvh/a.cpp", "// why\n\n  #  include <pah/accel/accelerator.hpp>\n") ==
          Faults{"src/bvh/a.cpp:3: bvh must not include accel"});
  }
  SECTION("a module of a higher rank, or of the same") {
    must_be_found({
        {"include/pah/render/a.hpp", "<pah/load/load_scene.hpp>",
         "render must not include load/scene/sections"},
        {"src/load/scene/a.cpp", "\"report/stats.hpp\""},
        {"src/load/scene/a.cpp", "<pah/render/film.hpp>"},
        {"src/base/a.cpp", "<pah/geometry/vec.hpp>"},
        {"src/accel/a.cpp", "<pah/scene/scene.hpp>", "accel must not include scene"},
        {"src/influence/a.cpp", "\"bvh/bvh.hpp\""},
    });
  }
  SECTION("a floor of the same module that a file does not stand on") {
    must_be_found({
        {"src/load/yaml/a.cpp", "\"load/mesh/common/text.hpp\"",
         "load/yaml must not include load/mesh/common"},
        {"src/load/mesh/gltf/a.cpp", "\"load/yaml/tree.hpp\""},
        {"src/load/mesh/gltf/a.cpp", "\"load/mesh/obj/obj.hpp\""},
        {"src/load/mesh/common/a.cpp", "\"load/mesh/gltf/gltf.hpp\""},
        {"src/load/scene/sections/a.cpp", "\"load/scene/animation.hpp\""},
        {"src/render/light/a.cpp", "\"render/path/path_tracer.hpp\""},
        {"src/render/bsdf/a.cpp", "\"render/light/lights.hpp\""},
        {"src/report/a.cpp", "\"report/study/study.hpp\"", "report must not include report/study"},
        {"src/cli/terminal/a.cpp", "\"cli/render/frames.hpp\""},
        {"src/image/picture/a.cpp", "\"image/srgb.hpp\""},
    });
  }
  SECTION("a floor's public header") {
    must_be_found({
        {"src/load/mesh/gltf/a.cpp", "<pah/load/load_scene.hpp>"},
        {"src/load/yaml/a.cpp", "<pah/load/mesh_file.hpp>"},
        {"include/pah/load/mesh_file.hpp", "<pah/load/load_scene.hpp>"},
        {"src/render/light/a.cpp", "<pah/render/session.hpp>"},
    });
  }
  SECTION("a module of a lower rank that a floor must not know") {
    must_be_found({
        {"src/load/yaml/a.cpp", "<pah/scene/scene.hpp>", "load/yaml must not include scene"},
        {"src/load/mesh/gltf/a.cpp", "\"scene/origin.hpp\""},
    });
  }
  SECTION("a private header in a public one") {
    must_be_found({{"include/pah/load/a.hpp", "\"base/output_file.hpp\""}});
  }
  SECTION("a third party out of its place") {
    must_be_found({
        {"src/scene/a.cpp", "<OpenImageIO/imageio.h>",
         "OpenImageIO/imageio.h must not be included here"},
        {"src/load/scene/sections/a.cpp", "<OpenImageIO/imageio.h>"},
        {"src/report/a.cpp", "<yaml-cpp/yaml.h>"},
        {"src/load/scene/sections/a.cpp", "<yaml-cpp/yaml.h>"},
        {"src/load/scene/sections/a.cpp", "<nlohmann/json.hpp>"},
        {"src/render/path/a.cpp", "<nlohmann/json.hpp>"},
        {"src/render/path/a.cpp", "<fmt/format.h>"},
        {"src/report/a.cpp", "<CLI/CLI.hpp>"},
        {"include/pah/scene/a.hpp", "<tbb/task_arena.h>"},
        {"src/bvh/a.cpp", "<tbb/parallel_for.h>"},
        {"src/cli/a.cpp", "<nlohmann/json.hpp>"},
        {"src/geometry/a.cpp", "<unistd.h>"},
    });
  }
  SECTION("CGAL, and every third party without an entry") {
    must_be_found({{"src/geometry/a.cpp", "<CGAL/Exact_kernel.h>"},
                   {"src/load/yaml/a.cpp", "<boost/any.hpp>"}});
  }
  SECTION("a folder or header that belongs to no module, or to no floor of it") {
    CHECK(faults_of("src/load/xml/a.cpp", "#include <vector>\n") ==
          Faults{"src/load/xml/a.cpp: no floor load/xml"});
    CHECK(faults_of("src/load/yaml/deep/a.cpp", "#include <vector>\n").size() == 1);
    CHECK(faults_of("src/util/a.cpp", "#include <vector>\n").size() == 1);
    CHECK(faults_of("src/load/yaml/a.cpp", "#include \"util/a.hpp\"\n").size() == 1);
  }
}
