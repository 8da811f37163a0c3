// A point of a surface that a ray met, and rays from it to lights, as a render sends them.
#pragma once

#include <pah/geometry/exact_bundle.hpp>
#include <pah/scene/world.hpp>

#include "render/surface/spawn.hpp"

namespace pah {

struct SeenPoint {
  SurfacePoint point;
  Vec3 side{0};  // the normal on the side that it is seen from
};

// `hit` is valid.
[[nodiscard]] SeenPoint seen_point(const World& world, const Ray& ray, const Hit& hit);

// Returns whether the light is on that side and the point within the light's cone, without regard
// to occlusion.
[[nodiscard]] bool is_lit(const SeenPoint& at, const ExactBundle& light);

// `lean`, in the unit disk, is where in a light of some size the ray ends; zero is its center.
[[nodiscard]] Ray ray_to(const SeenPoint& from, const ExactBundle& light, std::uint32_t bundle,
                         const Vec2& lean = Vec2(0));

}  // namespace pah
