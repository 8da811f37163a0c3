// Scenes made by code at any number of triangles: their extent stays the same, what fills it gets
// more and finer.
#pragma once

#include <pah/scene/scene.hpp>
#include <string>
#include <vector>

namespace pah::bench {

// A kind of scene, `forest`, `hall` or `city`, and about how many triangles: "forest_100k",
// "city_5m".
[[nodiscard]] bool is_generated(const std::string& name);

// Whether those are asked for that take minutes: by the environment variable PAHRENDER_LARGE.
[[nodiscard]] bool large_scenes();

// One of each kind of 100 k and of a million triangles, and large ones of 5 million.
[[nodiscard]] std::vector<std::string> generated_scene_names();

// Lit by a bulb, a sun without angle and a spot, in this order. From 10k to 10m triangles.
[[nodiscard]] Scene generated_scene(const std::string& name);

}  // namespace pah::bench
