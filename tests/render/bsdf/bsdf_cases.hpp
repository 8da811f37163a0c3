// The BSDFs and viewing directions for tests.
#pragma once

#include <string>
#include <vector>

#include "render/bsdf/bsdf.hpp"

namespace pah::test {

struct BsdfCase {
  std::string name;
  Bsdf bsdf;
};

// White if the model allows it, so that gained or lost energy shows.
std::vector<BsdfCase> rough_bsdfs();
std::vector<BsdfCase> smooth_bsdfs();

// Returns a unit vector; it points inside if cos_theta < 0.
Vec3 direction(float cos_theta, float phi);

}  // namespace pah::test
