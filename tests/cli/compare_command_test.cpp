#include <limits>
#include <nlohmann/json.hpp>
#include <pah/geometry/vec.hpp>
#include <pah/image/image_file.hpp>

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah::test;
using pah::CurrentTemporaryFolder;

namespace {

// Writes a picture of 2 x 1 pixels, the first with the given red.
void write_picture(const std::string& name, float red) {
  pah::Image image;
  image.width = 2;
  image.height = 1;
  image.pixels = {pah::Vec3{red, 0.25F, 0.25F}, pah::Vec3{0.25F}};
  pah::WriteOptions options;
  options.full_float = true;
  pah::write_image(name, {{"", {"R", "G", "B"}, image}}, options);
}

}  // namespace

TEST_CASE("Compare prints what differs") {
  const CurrentTemporaryFolder folder;
  write_picture("a.exr", 0.5F);
  write_picture("b.exr", 0.25F);
  const Outcome text = run({"compare", "a.exr", "b.exr"});
  CHECK(text.exit_code == 0);
  CHECK(text.err.empty());
  CHECK(text.out.find("relmse") != std::string::npos);

  const Outcome json = run({"compare", "a.exr", "b.exr", "--json"});
  CHECK(json.exit_code == 0);
  const auto difference = nlohmann::json::parse(json.out);
  const double square = 0.25 * 0.25 / 6;  // one of six values
  CHECK(difference["max"].get<double>() == 0.25);
  CHECK(difference["mse"].get<double>() == Approx(square));
  CHECK(difference["relmse"].get<double>() == Approx(square / (0.25 * 0.25 + 0.01)));
}

TEST_CASE("Compare fails beyond the threshold only") {
  const CurrentTemporaryFolder folder;
  write_picture("a.exr", 0.5F);
  write_picture("b.exr", 0.25F);
  write_picture("nan.exr", std::numeric_limits<float>::quiet_NaN());
  CHECK(run({"compare", "a.exr", "b.exr", "--threshold", "0.25"}).exit_code == 0);
  CHECK(run({"compare", "a.exr", "b.exr", "--threshold", "0.2499"}).exit_code == 1);
  CHECK(run({"compare", "a.exr", "a.exr", "--threshold", "0"}).exit_code == 0);
  CHECK(run({"compare", "nan.exr", "b.exr", "--threshold", "100"}).exit_code == 1);
}

TEST_CASE("Compare names pictures that it cannot compare") {
  const CurrentTemporaryFolder folder;
  write_picture("a.exr", 0.5F);
  pah::Image small;
  small.width = small.height = 1;
  small.pixels = {pah::Vec3{1}};
  pah::write_image("small.exr", {{"", {"R", "G", "B"}, small}});
  write_file("bad.exr", "not a picture");
  CHECK(run({"compare", "a.exr", "small.exr"}).exit_code == 1);
  CHECK(run({"compare", "a.exr", "missing.exr"}).exit_code == 4);
  CHECK(run({"compare", "a.exr", "bad.exr"}).exit_code == 4);
  CHECK(run({"compare", "a.exr"}).exit_code == 2);
  CHECK(run({"compare", "a.exr", "a.exr", "--threshold", "-1"}).exit_code == 2);
}
