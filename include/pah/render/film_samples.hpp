// Which samples a film holds.
#pragma once

#include <cstddef>
#include <vector>

namespace pah {

// Every pixel has the samples [from, to). All but those of the tiles `behind`, which are indices in
// RenderSession::tiles(), have the `ahead` next ones besides: a pass was stopped.
struct FilmSamples {
  int from = 0, to = 0;
  int ahead = 0;                    // 0 if no tile is behind
  std::vector<std::size_t> behind;  // ascending

  [[nodiscard]] bool operator==(const FilmSamples&) const = default;
};

}  // namespace pah
