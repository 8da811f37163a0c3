// Keyframes give a value for each frame: {keys: {0: 1, 24: [...]}, interpolation: smooth}.
#pragma once

#include <span>

#include "load/yaml/reader.hpp"

namespace pah {

enum class Interpolation {
  linear,
  smooth,  // continuous speed that is 0 at both ends, without overshoot
};

struct Key {
  double at = 0;
  double value = 0;
};

// Interpolates between `keys`, of which there is at least one, in ascending order. Outside of them,
// the value is that of the first or last key.
[[nodiscard]] double interpolate(std::span<const Key> keys, double at, Interpolation interpolation);

// Returns whether a map holds keyframes: `keys` that include a number.
[[nodiscard]] bool is_keyframes(const YamlNode& map);

// Returns the number or list of numbers at `frame`, or reports errors and returns null. Without a
// node, describes keyframes for the language.
[[nodiscard]] YamlRef read_keyframes(ReadContext& context, const YamlNode* node, double frame);

}  // namespace pah
