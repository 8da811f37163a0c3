#include "bsdf_cases.hpp"

#include <cmath>

#include "render/bsdf/coated.hpp"

namespace pah::test {

std::vector<BsdfCase> rough_bsdfs() {
  const Vec3 white{1};
  std::vector<BsdfCase> cases{{"diffuse", DiffuseBsdf{white}}};
  for (const float alpha : {0.05F, 0.3F, 1.0F}) {
    const std::string suffix = " alpha " + std::to_string(alpha);
    cases.push_back({"copper" + suffix, MetalBsdf{{0.2F, 0.9F, 1.1F}, {3.9F, 2.4F, 2.2F}, alpha}});
    for (const float eta : {1.5F, 1 / 1.33F}) {
      const std::string index = " ior " + std::to_string(eta);
      cases.push_back({"glass" + index + suffix, GlassBsdf{eta, alpha, white, white}});
    }
    cases.push_back(
        {"tinted glass" + suffix, GlassBsdf{2.4F, alpha, {0.9F, 0.1F, 0.2F}, {0.1F, 0.6F, 0.3F}}});
    cases.push_back({"plastic" + suffix, make_plastic({1, 0.5F, 0.1F}, 1.5F, alpha)});
    cases.push_back({"principled" + suffix, make_principled({1, 0.7F, 0.3F}, 0.4F, 1.5F, alpha)});
    cases.push_back({"principled metal" + suffix, make_principled(white, 1, 1.5F, alpha)});
  }
  return cases;
}

std::vector<BsdfCase> smooth_bsdfs() {
  const Vec3 white{1};
  return {{"mirror", MirrorBsdf{white}},
          {"glass", GlassBsdf{1.5F, 0, white, white}},
          {"glass of low index", GlassBsdf{1 / 1.5F, 0, white, white}},
          {"metal", MetalBsdf{Vec3{0.2F}, Vec3{3.9F}, 0, white}},
          {"plastic", make_plastic(white, 1.5F, 0)},
          {"principled", make_principled(white, 0.3F, 1.5F, 0)},
          {"principled metal", make_principled(white, 1, 1.5F, 0)}};
}

Vec3 direction(float cos_theta, float phi) {
  const float r = std::sqrt((1 - cos_theta) * (1 + cos_theta));
  return {r * std::cos(phi), r * std::sin(phi), cos_theta};
}

}  // namespace pah::test
