#include <algorithm>
#include <filesystem>

#include "catch.hpp"
#include "program.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;

namespace {

const std::string knot = pah::test::source_folder() / "scenes" / "meshes" / "knot.obj";

}  // namespace

TEST_CASE("Study writes its tables and its report") {
  const CurrentTemporaryFolder folder;
  write_file("small.yaml", small_scene);
  const Outcome outcome =
      run({"study", knot, "small.yaml", "-o", "made/here", "--quick", "--rays", "500"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  for (const char* name : {"prediction.csv", "cost.csv", "build.csv", "sweep.csv", "rays.csv",
                           "report.md", "prediction.gp", "cost.gp", "sweep.gp", "rays.gp"})
    CHECK(!read_file(std::string("made/here/") + name).empty());
  const std::string report = read_file("made/here/report.md");
  CHECK(report.find("| knot |") != std::string::npos);
  CHECK(report.find("| small |") != std::string::npos);
  CHECK(report.find("| knot | camera nearest |") != std::string::npos);
  CHECK(report.find("| small | shadow any |") != std::string::npos);
  // Either there are plots, or the report and the program say why not.
  const bool plotted = std::filesystem::exists("made/here/cost.svg");
  CHECK((report.find("No plots") == std::string::npos) == plotted);
  CHECK((outcome.err.find("plots skipped") == std::string::npos) == plotted);
}

TEST_CASE("Study names files that it cannot study") {
  const CurrentTemporaryFolder folder;
  write_file("bad.obj", "v 0 0 0\nf 1 2 3\n");
  write_file("bad.yaml", "camera: 7\n");
  write_file("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  write_file("taken", "a file");
  const Outcome bad = run({"study", "bad.obj", "bad.yaml", "-o", "out"});
  CHECK(bad.exit_code == 3);
  CHECK(bad.err.find("bad.obj") != std::string::npos);
  CHECK(bad.err.find("bad.yaml:1") != std::string::npos);
  CHECK(run({"study", "point.obj", "-o", "out"}).exit_code == 3);
  CHECK(run({"study", "missing.obj", "-o", "out"}).exit_code == 4);
  CHECK(run({"study", "missing.yaml", "-o", "out"}).exit_code == 4);
  CHECK(run({"study", knot, "-o", "taken"}).exit_code == 4);
  CHECK(run({"study", knot, "-o", "taken/under"}).exit_code == 4);
  CHECK(run({"study", "-o", "out"}).exit_code == 2);
  CHECK(run({"study", knot}).exit_code == 2);
  CHECK(run({"study", "taken", "-o", "out"}).exit_code == 2);
  CHECK(run({"study", knot, "-o", "out", "--rays", "0"}).exit_code == 2);
}
