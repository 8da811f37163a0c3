// Compares pictures with their references. See golden/README.md.
#include <fmt/format.h>

#include <filesystem>

#include "catch.hpp"
#include "failure_pictures.hpp"
#include "reference.hpp"
#include "t_test.hpp"

using namespace pah;

namespace {

constexpr std::uint64_t test_seed = 1;

// Enough to detect a change of albedo by one percent in most scenes. In the Cornell box the noise
// of indirect light hides it.
constexpr int few_batches = 4;
// Enough to detect a change by one percent in every scene.
int many_batches(const std::string& name) { return name == "cornell" ? 16 : few_batches; }

// With sanitizers, all scenes would take too long.
const std::vector<std::string> scenes(golden::scene_names.begin(),
                                      PAH_GOLDEN_FIRST_ONLY ? golden::scene_names.begin() + 1
                                                            : golden::scene_names.end());

// Multiplies all reflectances by `factor`.
void scale_albedo(Scene& scene, float factor) {
  struct Scale {
    float factor;
    void operator()(DiffuseMaterial& m) const { m.reflectance.value *= factor; }
    void operator()(MirrorMaterial& m) const { m.reflectance.value *= factor; }
    void operator()(GlassMaterial& m) const {
      m.reflectance.value *= factor;
      m.transmittance.value *= factor;
    }
    void operator()(MetalMaterial& m) const { m.tint.value *= factor; }
    void operator()(PlasticMaterial& m) const { m.reflectance.value *= factor; }
    void operator()(PrincipledMaterial& m) const { m.base_color.value *= factor; }
  };
  for (Material& material : scene.materials) std::visit(Scale{factor}, material.model);
}

void expect_reference(
    const std::string& name, int batches,
    std::unique_ptr<Accelerator> (*make_accelerator)(Triangles) = make_global_bvh) {
  CAPTURE(name);
  const LoadedScene loaded = golden::load_golden(name);
  const golden::Reference reference = golden::read_reference(name);
  // If this fails, the scene has changed: build the target regenerate_golden.
  REQUIRE(loaded.hash == reference.scene_hash);
  REQUIRE(loaded.scene.film.width == reference.batches.width());
  REQUIRE(loaded.scene.film.height == reference.batches.height());
  const golden::Batches picture =
      golden::render_batches(loaded.scene, test_seed, batches, make_accelerator);
  const golden::Comparison comparison = golden::compare(reference.batches, picture);
  if (comparison.passed < golden::passing_share) {
    const auto folder = golden::write_failure(name, reference.batches, picture, comparison);
    UNSCOPED_INFO("pictures in " << folder.string());
  }
  CHECK(comparison.passed >= golden::passing_share);
}

void expect_change_rejected(const std::string& name) {
  CAPTURE(name);
  Scene scene = golden::load_golden(name).scene;
  scale_albedo(scene, 0.99F);
  const golden::Reference reference = golden::read_reference(name);
  const golden::Batches picture = golden::render_batches(scene, test_seed, many_batches(name));
  CHECK(golden::compare(reference.batches, picture).passed < golden::passing_share);
}

}  // namespace

TEST_CASE("Every golden scene renders as its reference") {
  for (const std::string& name : scenes) expect_reference(name, few_batches);
}

TEST_CASE("Embree's pictures are within the references' error, too") {
  if (!has_embree()) {
    WARN("skipped: this was built without Embree");
    return;
  }
  for (const std::string& name : scenes) {
    expect_reference(name, few_batches, [](Triangles triangles) { return make_embree(triangles); });
  }
}

TEST_CASE("A change of albedo by one percent is rejected in a golden scene") {
  expect_change_rejected(scenes.front());
}

TEST_CASE("With many batches every golden scene renders as its reference", "[full]") {
  for (const std::string& name : scenes) expect_reference(name, many_batches(name));
}

TEST_CASE("A change of albedo by one percent is rejected in every golden scene", "[full]") {
  for (const std::string& name : scenes) expect_change_rejected(name);
}
