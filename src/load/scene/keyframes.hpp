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

// Interpolates; constant before the first and after the last key. `keys` are ascending and not
// empty.
[[nodiscard]] double interpolate(std::span<const Key> keys, double at, Interpolation interpolation);

// Returns whether a map holds keyframes.
[[nodiscard]] bool is_keyframes(const YamlNode& map);

// Returns the number or list of numbers at `frame`; reports errors and returns null otherwise.
// Without a node it describes its keys.
[[nodiscard]] YamlRef read_keyframes(ReadContext& context, const YamlNode* node, double frame);

}  // namespace pah
