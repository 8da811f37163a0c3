// Pictures as values.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace pah {

// A linear Rec. 709 picture, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;

  [[nodiscard]] const glm::vec3& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

}  // namespace pah
