#include <fstream>
#include <map>

#include "catch.hpp"
#include "include_rules.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using pah::testing::broken_include_rules;

namespace {

// A made-up tree of files.
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

TEST_CASE("every module includes only what stands to its left") {
  const fs::path root = pah::test::source_folder();
  REQUIRE(fs::exists(root / "src" / "cli" / "main.cpp"));
  std::string all;
  for (const std::string& fault : broken_include_rules(root)) all += fault + "\n";
  INFO(all);
  CHECK(all.empty());
}

TEST_CASE("allowed includes pass") {
  const Tree tree({
      {"include/pah/bvh/bvh.hpp", "#include <pah/geometry/aabb.hpp>\n#include <glm/vec3.hpp>\n"},
      {"src/bvh/bvh.cpp",
       "#include \"bvh/bvh.hpp\"\n#include \"near.hpp\"\n"
       "#include \"parallel/parallel_for.hpp\"\n"
       "// #include <CGAL/box.h> in a comment\n"},
      {"src/scene/texture_store.cpp", "#include <OpenImageIO/texture.h>\n"},
      {"src/parallel/parallel_for.cpp", "#include <tbb/parallel_for.h>\n"},
      {"src/io/image_file.cpp",
       "#include <OpenImageIO/imageio.h>\n#include \"io/output_file.hpp\"\n"
       "#include <pah/render/film.hpp>\n"},
      {"src/io/yaml/tree.cpp",
       "#include \"io/yaml/tree.hpp\"\n#include <yaml-cpp/yaml.h>\n"
       "#include <pah/io/errors.hpp>\n#include <pah/geometry/vec.hpp>\n"},
      {"src/io/mesh/mesh_file.cpp",
       "#include <pah/io/mesh_file.hpp>\n#include <fmt/format.h>\n"
       "#include \"io/image_header.hpp\"\n#include <pah/scene/camera.hpp>\n"},
      {"src/io/scene/load_scene.cpp",
       "#include <pah/io/load_scene.hpp>\n#include <pah/io/mesh_file.hpp>\n"
       "#include \"io/yaml/tree.hpp\"\n#include \"io/mesh/access.hpp\"\n"
       "#include \"scene/texture_store.hpp\"\n#include \"near.hpp\"\n"},
      {"src/report/study/study.cpp",
       "#include \"report/json_value.hpp\"\n#include \"io/output_file.hpp\"\n"},
      {"src/cli/main.cpp",
       "#include <CLI/CLI.hpp>\n#include <unistd.h>\n#include \"report/stats.hpp\"\n"
       "#include \"report/study/study.hpp\"\n"},
  });
  CHECK(broken_include_rules(tree.root()).empty());
}

TEST_CASE("planted faults are found, with their place") {
  using Faults = std::vector<std::string>;
  SECTION("a module to the right") {
    CHECK(faults_of("src/bvh/a.cpp", "// why\n\n  #  include <pah/accel/accelerator.hpp>\n") ==
          Faults{"src/bvh/a.cpp:3: bvh must not include accel"});
    CHECK(faults_of("include/pah/render/a.hpp", "#include <pah/io/image_file.hpp>\n") ==
          Faults{"include/pah/render/a.hpp:1: render must not include io"});
    CHECK(faults_of("src/io/a.cpp", "#include \"report/stats.hpp\"\n").size() == 1);
  }
  SECTION("a neighbor between the same two bars") {
    CHECK(faults_of("src/accel/a.cpp", "#include <pah/scene/scene.hpp>\n") ==
          Faults{"src/accel/a.cpp:1: accel must not include scene"});
    CHECK(faults_of("src/influence/a.cpp", "#include \"bvh/bvh.hpp\"\n").size() == 1);
  }
  SECTION("a floor of the same module that it does not stand on") {
    CHECK(faults_of("src/io/yaml/a.cpp", "#include \"io/mesh/access.hpp\"\n") ==
          Faults{"src/io/yaml/a.cpp:1: io/yaml must not include io/mesh"});
    CHECK(faults_of("src/io/mesh/a.cpp", "#include \"io/yaml/tree.hpp\"\n").size() == 1);
    CHECK(faults_of("src/io/yaml/a.cpp", "#include \"io/scene/reading.hpp\"\n").size() == 1);
    CHECK(faults_of("src/io/mesh/a.cpp", "#include \"io/scene/reading.hpp\"\n").size() == 1);
  }
  SECTION("a floor in its module's own folder") {
    CHECK(faults_of("src/io/a.cpp", "#include \"io/yaml/tree.hpp\"\n") ==
          Faults{"src/io/a.cpp:1: io must not include io/yaml"});
    CHECK(faults_of("src/report/a.cpp", "#include \"report/study/study.hpp\"\n").size() == 1);
    CHECK(faults_of("include/pah/io/a.hpp", "#include <pah/io/load_scene.hpp>\n").size() == 1);
  }
  SECTION("a floor's public header") {
    CHECK(faults_of("src/io/mesh/a.cpp", "#include <pah/io/load_scene.hpp>\n") ==
          Faults{"src/io/mesh/a.cpp:1: io/mesh must not include io/scene"});
    CHECK(faults_of("src/io/yaml/a.cpp", "#include <pah/io/mesh_file.hpp>\n").size() == 1);
    CHECK(faults_of("include/pah/io/mesh_file.hpp", "#include <pah/io/load_scene.hpp>\n").size() ==
          1);
  }
  SECTION("a module to the left that a floor must not know") {
    CHECK(faults_of("src/io/yaml/a.cpp", "#include <pah/scene/scene.hpp>\n") ==
          Faults{"src/io/yaml/a.cpp:1: io/yaml must not include scene"});
    CHECK(faults_of("src/io/mesh/a.cpp", "#include \"scene/texture_store.hpp\"\n").size() == 1);
    CHECK(faults_of("src/io/mesh/a.cpp", "#include <pah/render/film.hpp>\n").size() == 1);
    CHECK(faults_of("src/io/scene/a.cpp", "#include \"report/stats.hpp\"\n").size() == 1);
  }
  SECTION("a private header in a public one") {
    CHECK(faults_of("include/pah/io/a.hpp", "#include \"io/atomic.hpp\"\n").size() == 1);
  }
  SECTION("a third party out of its place") {
    CHECK(faults_of("src/scene/a.cpp", "#include <OpenImageIO/imageio.h>\n") ==
          Faults{"src/scene/a.cpp:1: OpenImageIO/imageio.h must not be included here"});
    CHECK(faults_of("src/report/a.cpp", "#include <yaml-cpp/yaml.h>\n").size() == 1);
    CHECK(faults_of("src/io/a.cpp", "#include <yaml-cpp/yaml.h>\n").size() == 1);
    CHECK(faults_of("src/io/scene/a.cpp", "#include <yaml-cpp/yaml.h>\n").size() == 1);
    CHECK(faults_of("src/io/scene/a.cpp", "#include <nlohmann/json.hpp>\n").size() == 1);
    CHECK(faults_of("src/io/scene/a.cpp", "#include <OpenImageIO/imageio.h>\n").size() == 1);
    CHECK(faults_of("src/render/a.cpp", "#include <nlohmann/json.hpp>\n").size() == 1);
    CHECK(faults_of("src/render/a.cpp", "#include <fmt/format.h>\n").size() == 1);
    CHECK(faults_of("src/report/a.cpp", "#include <CLI/CLI.hpp>\n").size() == 1);
    CHECK(faults_of("include/pah/scene/a.hpp", "#include <tbb/task_arena.h>\n").size() == 1);
    CHECK(faults_of("src/bvh/a.cpp", "#include <tbb/parallel_for.h>\n").size() == 1);
    CHECK(faults_of("src/cli/a.cpp", "#include <nlohmann/json.hpp>\n").size() == 1);
    CHECK(faults_of("src/geometry/a.cpp", "#include <unistd.h>\n").size() == 1);
  }
  SECTION("CGAL, and whatever nobody has named") {
    CHECK(faults_of("src/geometry/a.cpp", "#include <CGAL/Exact_kernel.h>\n").size() == 1);
    CHECK(faults_of("src/io/a.cpp", "#include <boost/any.hpp>\n").size() == 1);
  }
  SECTION("a folder or header that belongs to no module, or to no floor of it") {
    CHECK(faults_of("src/io/xml/a.cpp", "#include <vector>\n") ==
          Faults{"src/io/xml/a.cpp: no floor io/xml"});
    CHECK(faults_of("src/io/yaml/deep/a.cpp", "#include <vector>\n").size() == 1);
    CHECK(faults_of("src/util/a.cpp", "#include <vector>\n").size() == 1);
    CHECK(faults_of("src/io/a.cpp", "#include \"util/a.hpp\"\n").size() == 1);
  }
}
