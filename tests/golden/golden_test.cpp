// Pictures against their references. See golden/README.md.
#include <fmt/format.h>

#include <filesystem>

#include "catch.hpp"
#include "failure_pictures.hpp"
#include "reference.hpp"
#include "t_test.hpp"

using namespace pah;

namespace {

constexpr std::uint64_t test_seed = 1;

// Enough for one percent to stand out from the noise; most of what the Cornell box shows is
// indirect light, which has more of it.
int batches_for(const std::string& name) { return name == "cornell" ? 16 : 4; }

// Sanitizers cost too much time for all of them.
const std::vector<std::string> scenes(golden::scene_names.begin(),
                                      PAH_GOLDEN_FIRST_ONLY ? golden::scene_names.begin() + 1
                                                            : golden::scene_names.end());

// Everything that reflects, times `factor`.
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

}  // namespace

TEST_CASE("Every golden scene renders as its reference") {
  for (const std::string& name : scenes) {
    CAPTURE(name);
    const LoadedScene loaded = golden::load_golden(name);
    const golden::Reference reference = golden::read_reference(name);
    // If this fails, the scene has changed: build the target regenerate_golden.
    REQUIRE(loaded.hash == reference.scene_hash);
    REQUIRE(loaded.scene.film.width == reference.batches.width());
    REQUIRE(loaded.scene.film.height == reference.batches.height());
    const golden::Batches picture =
        golden::render_batches(loaded.scene, test_seed, batches_for(name));
    const golden::Comparison comparison = golden::compare(reference.batches, picture);
    if (comparison.passed < golden::passing_share) {
      const auto folder = golden::write_failure(name, reference.batches, picture, comparison);
      UNSCOPED_INFO("pictures in " << folder.string());
    }
    CHECK(comparison.passed >= golden::passing_share);
  }
}

TEST_CASE("A change of albedo by one percent is rejected in every golden scene") {
  for (const std::string& name : scenes) {
    CAPTURE(name);
    Scene scene = golden::load_golden(name).scene;
    scale_albedo(scene, 0.99F);
    const golden::Reference reference = golden::read_reference(name);
    const golden::Batches picture = golden::render_batches(scene, test_seed, batches_for(name));
    const golden::Comparison comparison = golden::compare(reference.batches, picture);
    CHECK(comparison.passed < golden::passing_share);
  }
}
