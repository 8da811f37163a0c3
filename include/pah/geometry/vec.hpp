// Vector types: GLM's, under short names.
//
// Coordinates are right-handed with y up. World positions are double until a World recenters them
// (scene/world.hpp); all geometry that rays are traced against is float.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace pah {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;
using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;
using UVec3 = glm::uvec3;

}  // namespace pah
