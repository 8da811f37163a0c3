// Tests that BSDFs draw directions with the density that they state.
#include <algorithm>

#include "bsdf_cases.hpp"
#include "catch.hpp"
#include "chi_square.hpp"
#include "render/bsdf/coated.hpp"
#include "render/bsdf/microfacet.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// Directions near grazing, oblique and near the normal, from outside and from inside.
constexpr float cosines[] = {0.95F, 0.5F, 0.02F, -0.7F, -0.3F};

ChiSquare test_bsdf(const Bsdf& bsdf, const Vec3& wo, double pdf_factor, int count, Rng& rng) {
  return chi_square_sphere(
      [&](Rng& r) -> std::optional<Vec3> {
        const float u = uniform(r);
        const std::optional<BsdfSample> drawn = sample(bsdf, wo, u, uniform2(r));
        if (!drawn || drawn->specular) return std::nullopt;
        return drawn->wi;
      },
      [&](const Vec3& wi) { return pdf_factor * static_cast<double>(pdf(bsdf, wo, wi)); }, count,
      rng);
}

void test_all(int count, int runs, std::uint64_t seed) {
  std::vector<BsdfCase> cases = rough_bsdfs();
  cases.push_back({"smooth plastic", make_plastic(Vec3{0.5F}, 1.5F, 0)});
  const double level = sidak_level(static_cast<int>(cases.size() * std::size(cosines)) * runs);
  for (const BsdfCase& c : cases) {
    for (const float cos_theta : cosines) {
      const Vec3 wo = direction(cos_theta, 0.7F);
      for (int run = 0; run < runs; ++run) {
        Rng rng(seed++);
        const ChiSquare result = test_bsdf(c.bsdf, wo, 1, count, rng);
        INFO(c.name << " at " << cos_theta << ": p = " << result.p << ", statistic "
                    << result.statistic << " of " << result.degrees);
        CHECK(result.p > level);
        CHECK(result.integral < 1 + 1e-3);
      }
    }
  }
}

}  // namespace

TEST_CASE("BSDF samples follow the stated density") { test_all(50'000, 1, 100); }

TEST_CASE("BSDF samples follow the stated density in a million draws each", "[full]") {
  test_all(1'000'000, 5, 1000);
}

TEST_CASE("Visible normals follow their density") {
  int seed = 0;
  for (const float alpha : {0.05F, 0.3F, 1.0F}) {
    for (const float cos_theta : {1.0F, 0.6F, 0.1F, 0.001F}) {
      const Vec3 wo = direction(cos_theta, -2);
      Rng rng(static_cast<std::uint64_t>(++seed));
      const ChiSquare result =
          chi_square_sphere([&](Rng& r) { return sample_ggx_visible(wo, alpha, uniform2(r)); },
                            [&](const Vec3& h) {
                              if (h.z < 0) return 0.0;
                              return static_cast<double>(ggx_visible_density(wo, h, alpha)) *
                                     std::max(0.0, static_cast<double>(glm::dot(wo, h)));
                            },
                            200'000, rng);
      INFO("alpha " << alpha << ", cos " << cos_theta << ": p = " << result.p);
      CHECK(result.p > sidak_level(12));
      CHECK(result.integral == Approx(1).epsilon(1e-3));
    }
  }
}

TEST_CASE("A wrong density of a BSDF is rejected") {
  Rng rng(7);
  const Vec3 wo = direction(0.5F, 0.7F);
  const Bsdf metal = MetalBsdf{Vec3{0.2F}, Vec3{3}, 0.3F, Vec3{1}};
  CHECK(test_bsdf(metal, wo, 0.95, 50'000, rng).p < 1e-6);
  const Bsdf rougher = MetalBsdf{Vec3{0.2F}, Vec3{3}, 0.33F, Vec3{1}};
  const ChiSquare result = chi_square_sphere(
      [&](Rng& r) -> std::optional<Vec3> {
        const auto drawn = sample(metal, wo, 0, uniform2(r));
        return drawn ? std::optional<Vec3>(drawn->wi) : std::nullopt;
      },
      [&](const Vec3& wi) { return pdf(rougher, wo, wi); }, 50'000, rng);
  CHECK(result.p < 1e-6);
}
