// Damages files, for tests that every input is read or refused.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <string_view>

namespace pah {

// Makes one to three changes: replaces a byte, or removes, repeats or inserts some. `spice` holds
// characters that have a meaning in the format.
inline std::string mutated(std::string bytes, std::mt19937& random, std::string_view spice) {
  for (unsigned n = 1 + random() % 3; n-- > 0;) {
    if (bytes.empty()) bytes = spice;
    const std::size_t at = random() % bytes.size();
    const std::size_t count = 1 + random() % 4;
    switch (random() % 5) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, count);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random() % bytes.size(), count));
        break;
      case 3:
        bytes.insert(at, 1, spice[random() % spice.size()]);
        break;
      default:
        bytes[at] = spice[random() % spice.size()];
    }
  }
  return bytes;
}

}  // namespace pah
