// Chooses from a fixed list of weights in constant time: Walker's alias method, as built by Vose
// ("A Linear Algorithm For Generating Random Numbers With a Given Distribution", 1991).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pah {

class AliasTable {
 public:
  AliasTable() = default;
  // Weights >= 0 with a positive sum.
  explicit AliasTable(std::span<const double> weights) : bins_(weights.size()) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    std::vector<double> scaled(weights.size());
    std::vector<std::uint32_t> below, above;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      scaled[i] = weights[i] / sum * static_cast<double>(weights.size());
      (scaled[i] < 1 ? below : above).push_back(static_cast<std::uint32_t>(i));
    }
    while (!below.empty() && !above.empty()) {
      const std::uint32_t low = below.back(), high = above.back();
      below.pop_back();
      bins_[low] = {static_cast<float>(scaled[low]), high};
      scaled[high] -= 1 - scaled[low];
      if (scaled[high] < 1) {
        above.pop_back();
        below.push_back(high);
      }
    }
    for (const std::uint32_t i : above) bins_[i] = {1, i};
    for (const std::uint32_t i : below) bins_[i] = {1, i};
  }

  // u in [0, 1).
  [[nodiscard]] std::size_t sample(float u) const {
    const double place = static_cast<double>(u) * static_cast<double>(bins_.size());
    const auto i = static_cast<std::size_t>(place);
    return place - static_cast<double>(i) < static_cast<double>(bins_[i].share) ? i
                                                                                : bins_[i].alias;
  }

 private:
  struct Bin {
    float share = 1;
    std::uint32_t alias = 0;
  };
  std::vector<Bin> bins_;
};

}  // namespace pah
