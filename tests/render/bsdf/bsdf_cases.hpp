// BSDFs and viewing directions that the tests of BSDFs go through.
#pragma once

#include <string>
#include <vector>

#include "render/bsdf/bsdf.hpp"

namespace pah::test {

struct BsdfCase {
  std::string name;
  Bsdf bsdf;
};

// White where the model allows it: energy shows.
std::vector<BsdfCase> rough_bsdfs();
std::vector<BsdfCase> smooth_bsdfs();

// A unit vector; from inside if cos_theta < 0.
Vec3 direction(float cos_theta, float phi);

}  // namespace pah::test
