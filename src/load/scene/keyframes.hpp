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

// Interpolates; constant before the first and after the last key. `keys` are ascending and not
// empty.
[[nodiscard]] double interpolate(std::span<const Key> keys, double at, Interpolation interpolation);

// Returns whether a map holds keyframes.
[[nodiscard]] bool is_keyframes(const YamlNode& map);

// Returns the number or list of numbers at `frame`; reports errors and returns null otherwise.
// Without a node it describes its keys.
[[nodiscard]] YamlRef read_keyframes(ReadContext& context, const YamlNode* node, double frame);

}  // namespace pah
