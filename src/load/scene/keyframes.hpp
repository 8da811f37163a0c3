// {keys: {0: 1, 24: [...]}, interpolation: smooth}: a value by frame.
#pragma once

#include <span>

#include "load/yaml/reader.hpp"

namespace pah {

enum class Interpolation {
  linear,
  smooth,  // speeds change gradually, and are 0 at both ends; no value goes beyond its neighbors'
};

struct Key {
  double at = 0;
  double value = 0;
};

// Before the first key its value, after the last one that one's. `keys` ascend, and there is one.
[[nodiscard]] double interpolate(std::span<const Key> keys, double at, Interpolation interpolation);

// Whether a map is one of keyframes and not of other things by name.
[[nodiscard]] bool is_keyframes(const YamlNode& map);

// The number or list of numbers at `frame`, or null and errors. Without a node it is described.
[[nodiscard]] YamlRef read_keyframes(ReadContext& context, const YamlNode* node, double frame);

}  // namespace pah
