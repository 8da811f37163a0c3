// The golden scenes and their reference pictures, in the folder golden/.
#pragma once

#include <array>
#include <filesystem>
#include <pah/load/load_scene.hpp>
#include <string>

#include "batches.hpp"

namespace pah::golden {

// The first is the cheapest.
inline constexpr std::array scene_names{"lamps",        "cornell",         "columns",  "sky",
                                        "coated",       "glass_and_metal", "textured", "thin_lens",
                                        "orthographic", "scattered"};

// The seeds of the references; other pictures use other seeds.
inline constexpr std::uint64_t reference_seed = 1'000'000;
inline constexpr int reference_batches = 64;  // of 256 samples each, as the scenes say

struct Reference {
  Batches batches;
  std::string scene_hash;  // of the scene that it shows
};

[[nodiscard]] LoadedScene load_golden(const std::string& name);

// <name>_mean.exr, and <name>_variance.exr: the variance of that mean. Both throw FileError.
void write_reference(const std::string& name, const LoadedScene& scene, const Batches& batches);
[[nodiscard]] Reference read_reference(const std::string& name);

}  // namespace pah::golden
