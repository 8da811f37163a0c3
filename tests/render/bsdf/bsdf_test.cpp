#include "render/bsdf/bsdf.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bsdf_cases.hpp"
#include "catch.hpp"
#include "chi_square.hpp"
#include "render/bsdf/coated.hpp"
#include "render/bsdf/fresnel.hpp"
#include "render/bsdf/microfacet.hpp"
#include "support/fewer.hpp"

using namespace pah;
using namespace pah::test;

namespace {

float largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

Vec3 random_direction(Rng& rng) {
  const float z = 2 * uniform(rng) - 1;
  return direction(z, 6.2831853F * uniform(rng));
}

double index_of_side(const Bsdf& bsdf, const Vec3& w) {
  const auto* glass = std::get_if<GlassBsdf>(&bsdf);
  return glass && w.z < 0 ? static_cast<double>(glass->eta) : 1.0;
}

// Returns the share of a uniform field that is scattered to wo: 1 if nothing is absorbed. A uniform
// field has radiance n^2 in a medium of index n.
double furnace(const Bsdf& bsdf, const Vec3& wo, int count, Rng& rng, int channel = 0) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Stratified, so that few samples suffice.
    const float u = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    const std::optional<BsdfSample> drawn = sample(bsdf, wo, u, uniform2(rng));
    if (!drawn) continue;
    const double radiance = std::pow(index_of_side(bsdf, drawn->wi), 2);
    sum += radiance * static_cast<double>(drawn->weight[channel]);
  }
  return sum / count / std::pow(index_of_side(bsdf, wo), 2);
}

}  // namespace

TEST_CASE("A sample's weight and density are those of its direction") {
  Rng rng(1);
  const int count = fewer_if_sanitized(20'000);
  for (const BsdfCase& c : rough_bsdfs()) {
    CAPTURE(c.name);
    int compared = 0;
    for (int i = 0; i < count; ++i) {
      const Vec3 wo = random_direction(rng);
      const auto drawn = sample(c.bsdf, wo, uniform(rng), uniform2(rng));
      if (!drawn) continue;
      ++compared;
      const float density = pdf(c.bsdf, wo, drawn->wi);
      const Vec3 value = evaluate(c.bsdf, wo, drawn->wi);
      // Rounding of wi moves the half vector, by more where the lobe is narrow or the angle
      // grazing.
      const float bound = 0.02F;
      CAPTURE(wo.z, drawn->wi.z, drawn->pdf, density);
      REQUIRE(density > 0);
      REQUIRE(std::abs(density - drawn->pdf) <= bound * drawn->pdf);
      REQUIRE(largest(glm::abs(value - drawn->weight * drawn->pdf)) <=
              bound * drawn->pdf * (largest(drawn->weight) + 1e-3F));
      REQUIRE(drawn->transmission == (drawn->wi.z * wo.z < 0));
      REQUIRE_FALSE(drawn->specular);
    }
    CHECK(compared > count / 2);
  }
}

TEST_CASE("White furnace: BSDFs without absorption return all light") {
  Rng rng(2);
  for (const float cos_theta : {1.0F, 0.6F, 0.1F, 1e-3F}) {
    const Vec3 wo = direction(cos_theta, 1);
    CAPTURE(cos_theta);
    CHECK(furnace(DiffuseBsdf{Vec3{1}}, wo, 1000, rng) == Approx(1).epsilon(1e-3));
    CHECK(furnace(MirrorBsdf{Vec3{1}}, wo, 10, rng) == Approx(1).epsilon(1e-6));
    for (const float eta : {1.5F, 1 / 1.5F, 1.0F, 2.4F}) {
      CAPTURE(eta);
      const GlassBsdf glass{eta, 0, Vec3{1}, Vec3{1}};
      CHECK(furnace(glass, wo, 100'000, rng) == Approx(1).epsilon(1e-3));
      CHECK(furnace(glass, -wo, 100'000, rng) == Approx(1).epsilon(1e-3));
    }
    CHECK(furnace(make_plastic(Vec3{1}, 1.5F, 0), wo, 100'000, rng) == Approx(1).epsilon(2e-3));
    CHECK(furnace(make_principled(Vec3{1}, 0, 1.5F, 0), wo, 100'000, rng) ==
          Approx(1).epsilon(2e-3));
  }
}

TEST_CASE("No BSDF returns more light than it receives") {
  Rng rng(3);
  std::vector<BsdfCase> cases = rough_bsdfs();
  for (const BsdfCase& c : smooth_bsdfs()) cases.push_back(c);
  for (const float roughness : {0.05F, 0.1F, 0.2F, 0.4F, 0.6F, 0.8F, 1.0F}) {
    const float alpha = ggx_alpha(roughness);
    cases.push_back(
        {"white plastic " + std::to_string(roughness), make_plastic(Vec3{1}, 1.5F, alpha)});
    cases.push_back(
        {"dense plastic " + std::to_string(roughness), make_plastic(Vec3{1}, 2.5F, alpha)});
    cases.push_back({"white principled " + std::to_string(roughness),
                     make_principled(Vec3{1}, 0, 1.5F, alpha)});
  }
  double worst = 0;
  for (const BsdfCase& c : cases) {
    for (const float cos_theta : {1.0F, 0.8F, 0.5F, 0.3F, 0.1F, 0.01F, -0.01F, -0.4F, -1.0F}) {
      const double returned = furnace(c.bsdf, direction(cos_theta, 2), 20'000, rng);
      CAPTURE(c.name, cos_theta, returned);
      worst = std::max(worst, returned);
      CHECK(returned < 1.01);
    }
  }
  std::printf("largest albedo of all BSDFs: %.4f\n", worst);
}

TEST_CASE("Light lost by single scattering is reported") {
  // For a white conductor and a white dielectric, the difference to 1 is the light that one facet
  // passes to another.
  Rng rng(4);
  std::printf("share of light lost by single-scatter GGX, white metal | glass 1.5\n");
  std::printf("roughness      cos 1.0     cos 0.5     cos 0.1\n");
  double previous = -1;
  for (const float roughness : {0.2F, 0.5F, 1.0F}) {
    std::printf("%9.1f", static_cast<double>(roughness));
    double loss = 0;
    for (const float cos_theta : {1.0F, 0.5F, 0.1F}) {
      const float alpha = ggx_alpha(roughness);
      const Vec3 wo = direction(cos_theta, 1);
      const double metal = 1 - furnace(make_principled(Vec3{1}, 1, 1.5F, alpha), wo, 20'000, rng);
      const double glass = 1 - furnace(GlassBsdf{1.5F, alpha, Vec3{1}, Vec3{1}}, wo, 20'000, rng);
      std::printf("  %.3f|%.3f", metal, glass);
      CHECK(metal < 0.75);
      CHECK(metal > -0.005);
      loss += metal;
    }
    std::printf("\n");
    CHECK(loss > previous);
    previous = loss;
  }
  // At alpha 1 and normal incidence the mirrored directions are uniform over the sphere, half of
  // them lost, and G2 / G1 is 2 z / (1 + z): what returns is 1 - ln 2.
  CHECK(furnace(make_principled(Vec3{1}, 1, 1.5F, 1), {0, 0, 1}, 100'000, rng) ==
        Approx(1 - std::log(2.0)).epsilon(0.01));
}

namespace {

void test_reciprocity(int pairs) {
  for (const BsdfCase& c : rough_bsdfs()) {
    CAPTURE(c.name);
    Rng rng(5);
    double worst = 0;
    for (int i = 0; i < pairs; ++i) {
      const Vec3 wo = random_direction(rng);
      const Vec3 wi = random_direction(rng);
      if (wo.z == 0 || wi.z == 0) continue;
      const auto weigh = [&](const Vec3& from, const Vec3& to) {
        const double n = index_of_side(c.bsdf, from);
        return glm::dvec3{evaluate(c.bsdf, to, from)} * n * n /
               std::abs(static_cast<double>(from.z));
      };
      const glm::dvec3 there = weigh(wi, wo), back = weigh(wo, wi);
      for (int k = 0; k < 3; ++k) {
        const double larger = std::max(there[k], back[k]);
        if (larger > 0) worst = std::max(worst, std::abs(there[k] - back[k]) / larger);
      }
    }
    CHECK(worst < 1e-5);
  }
}

}  // namespace

TEST_CASE("BSDFs are reciprocal") { test_reciprocity(20'000); }
TEST_CASE("BSDFs are reciprocal, a million times", "[full]") { test_reciprocity(1'000'000); }

TEST_CASE("No direction, however grazing, gives anything but finite numbers") {
  Rng rng(6);
  std::vector<BsdfCase> cases = rough_bsdfs();
  for (const BsdfCase& c : smooth_bsdfs()) cases.push_back(c);
  cases.push_back({"narrowest metal", MetalBsdf{Vec3{0.2F}, Vec3{3}, min_ggx_alpha, Vec3{1}}});
  cases.push_back({"narrowest glass", GlassBsdf{1.5F, min_ggx_alpha, Vec3{1}, Vec3{1}}});
  cases.push_back({"narrowest plastic", make_plastic(Vec3{0.5F}, 1.5F, min_ggx_alpha)});
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v.x >= 0 && v.y >= 0 &&
           v.z >= 0;
  };
  const float last = 1 - 0x1p-24F;
  for (const BsdfCase& c : cases) {
    CAPTURE(c.name);
    for (const float cos_theta :
         {0.0F, -0.0F, 1e-45F, 1e-38F, 1e-20F, 1e-7F, 1e-3F, 0.5F, 1.0F, -1.0F, -1e-4F, -1e-30F}) {
      const Vec3 wo = direction(cos_theta, 0.3F);
      for (int i = 0; i < 500; ++i) {
        Vec2 u2 = uniform2(rng);
        if (i % 5 == 0) u2 = {(i % 2) != 0 ? last : 0, (i % 3) != 0 ? last : 0};
        const float u = i % 7 == 0 ? last : i % 7 == 1 ? 0 : uniform(rng);
        const auto drawn = sample(c.bsdf, wo, u, u2);
        CAPTURE(cos_theta, u, u2.x, u2.y);
        if (drawn) {
          REQUIRE(finite(drawn->weight));
          REQUIRE(std::isfinite(drawn->pdf));
          REQUIRE(drawn->pdf >= 0);
          REQUIRE(glm::length(drawn->wi) == Approx(1).margin(1e-5));
          // Weights are bounded, so that surfaces cause no fireflies. Light that leaves the denser
          // side is concentrated by at most the squared index.
          REQUIRE(largest(drawn->weight) < 7);
        }
        const float other = i % 2 == 0 ? cos_theta : 2 * uniform(rng) - 1;
        const Vec3 wi = direction(i % 4 == 0 ? -other : other, 6 * uniform(rng));
        REQUIRE(finite(evaluate(c.bsdf, wo, wi)));
        const float density = pdf(c.bsdf, wo, wi);
        REQUIRE(std::isfinite(density));
        REQUIRE(density >= 0);
      }
    }
  }
}

TEST_CASE("Smooth lobes are reported") {
  for (const BsdfCase& c : rough_bsdfs()) CHECK(has_smooth_lobes(c.bsdf));
  CHECK_FALSE(has_smooth_lobes(MirrorBsdf{}));
  CHECK_FALSE(has_smooth_lobes(GlassBsdf{}));
  CHECK_FALSE(has_smooth_lobes(MetalBsdf{}));
  CHECK(has_smooth_lobes(make_plastic(Vec3{0.5F}, 1.5F, 0)));
  CHECK_FALSE(has_smooth_lobes(make_principled(Vec3{0.5F}, 1, 1.5F, 0)));
}

TEST_CASE("Opaque surfaces are the same on both sides") {
  Rng rng(8);
  const Vec3 flip{1, 1, -1};
  for (const BsdfCase& c : rough_bsdfs()) {
    if (std::holds_alternative<GlassBsdf>(c.bsdf)) continue;
    for (int i = 0; i < 100; ++i) {
      const Vec3 wo = random_direction(rng), wi = random_direction(rng);
      CHECK(evaluate(c.bsdf, wo, wi) == evaluate(c.bsdf, wo * flip, wi * flip));
      if (wo.z * wi.z < 0) CHECK(evaluate(c.bsdf, wo, wi) == Vec3{0});
    }
  }
}

TEST_CASE("Smooth glass refracts by Snell's law and reflects totally beyond the critical angle") {
  const Vec3 wo = direction(0.6F, 0);
  const auto in = sample(GlassBsdf{1.5F}, wo, 0.99F, {0, 0});
  REQUIRE(in);
  CHECK(in->transmission);
  CHECK(in->specular);
  CHECK(in->wi.z < 0);
  CHECK(in->wi.x == Approx(-0.8 / 1.5));
  CHECK(in->weight.x == Approx(1 / 2.25));
  // sin 0.8 inside 1.5 is beyond the critical angle: 0.8 * 1.5 > 1.
  const auto back = sample(GlassBsdf{1.5F}, -wo, 0.99F, {0, 0});
  REQUIRE(back);
  CHECK_FALSE(back->transmission);
  CHECK(back->wi.z < 0);
  CHECK(back->weight.x == Approx(1));
}

TEST_CASE("Fresnel terms take known values") {
  CHECK(fresnel_dielectric(1, 1.5F).reflectance == Approx(0.04));
  CHECK(fresnel_dielectric(0, 1.5F).reflectance == Approx(1));
  CHECK(fresnel_dielectric(0.1F, 1 / 1.5F).reflectance == 1);
  // At Brewster's angle, tan = eta, only the perpendicular half is reflected.
  const double brewster = 1 / std::sqrt(1 + 1.5 * 1.5);
  const double perpendicular = (2.25 - 1) / (2.25 + 1);
  CHECK(fresnel_dielectric(static_cast<float>(brewster), 1.5F).reflectance ==
        Approx(perpendicular * perpendicular / 2).epsilon(1e-5));
  // Normal incidence on a conductor: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
  CHECK(fresnel_conductor(1, Vec3{0.2F}, Vec3{3.9F}).x ==
        Approx((0.64 + 15.21) / (1.44 + 15.21)).epsilon(1e-5));
  CHECK(fresnel_conductor(0, Vec3{0.2F}, Vec3{3.9F}).x == Approx(1));
  // Without absorption a conductor is a dielectric.
  for (const float c : {0.1F, 0.5F, 0.9F}) {
    CHECK(fresnel_conductor(c, Vec3{1.5F}, Vec3{0}).x ==
          Approx(fresnel_dielectric(c, 1.5F).reflectance).epsilon(1e-4));
  }
  for (const float c : {0.0F, 0.3F, 1.0F}) {
    for (const float eta : {0.0F, 1.0F, max_conductor_index}) {
      for (const float k : {0.0F, 1.0F, max_conductor_index}) {
        const float f = fresnel_conductor(c, Vec3{eta}, Vec3{k}).x;
        CHECK(f >= 0);
        CHECK(f <= 1.0001F);
      }
    }
  }
}

TEST_CASE("The mean Fresnel reflectance is the integral of the Fresnel reflectance") {
  for (const double eta : {1.00001, 1.001, 1.1, 1.33, 1.5, 2.4, 4.0, 0.75, 0.5}) {
    double sum = 0;
    constexpr int steps = 200'000;
    for (int i = 0; i < steps; ++i) {
      const double sin2 = (i + 0.5) / steps;  // 2 cos d(cos) = d(sin^2)
      const double c = std::sqrt(1 - sin2);
      const double s = sin2 / (eta * eta);
      double f = 1;
      if (s < 1) {
        const double t = std::sqrt(1 - s);
        const double a = (eta * c - t) / (eta * c + t), b = (c - eta * t) / (c + eta * t);
        f = (a * a + b * b) / 2;
      }
      sum += f / steps;
    }
    CAPTURE(eta);
    CHECK(average_fresnel_dielectric(static_cast<float>(eta)) == Approx(sum).margin(2e-5));
  }
}

TEST_CASE("The planted fault of an unscaled radiance shows in the furnace") {
  // Glass that forgets the squared index on one side returns 1.5^2 of the light that passes.
  Rng rng(9);
  const Vec3 wo = direction(0.8F, 0);
  const double wrong = furnace(GlassBsdf{1.5F, 0, Vec3{1}, Vec3{2.25F}}, wo, 100'000, rng);
  CHECK(wrong > 2);
}
