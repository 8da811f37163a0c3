// Which samples a film holds.
#pragma once

#include <cstddef>
#include <vector>

namespace pah {

// Every pixel has the samples [from, to). If a pass was stopped, the pixels of all tiles but those
// in `behind` (indices in RenderSession::tiles()) have `ahead` more.
struct FilmSamples {
  int from = 0, to = 0;
  int ahead = 0;                    // 0 if no tile is behind
  std::vector<std::size_t> behind;  // ascending

  [[nodiscard]] bool operator==(const FilmSamples&) const = default;
};

}  // namespace pah
