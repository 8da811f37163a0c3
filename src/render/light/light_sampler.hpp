// Chooses a light in proportion to its estimated contribution at the shading point.
//
// Lights with a position are in a tree whose nodes bound them. A single estimate for a group is
// poor if few of its lights reach the point, as with spots: it would choose groups none of whose
// lights does. So groups are opened until a small list is full, and one entry is then chosen. Few
// lights are thus weighed individually, and so are the remaining lights of many once groups out of
// reach are ruled out. After Conty Estevez & Kulla, "Importance Sampling of Many Lights with
// Adaptive Tree Splitting" (HPG 2018).
#pragma once

#include <array>
#include <optional>
#include <pah/scene/mesh.hpp>
#include <span>
#include <vector>

#include "render/light/light_importance.hpp"

namespace pah {

struct LightChoice {
  LightId light = no_light;
  float probability = 0;
};

class LightSampler {
 public:
  struct Placed {
    LightId light = no_light;
    LightBounds bounds;
  };
  struct Distant {
    LightId light = no_light;
    DistantBounds bounds;
  };

  LightSampler() = default;
  // The caller leaves out lights without power. Each light occurs once; ids are below `lights`.
  LightSampler(std::vector<Placed> placed, std::vector<Distant> distant, std::size_t lights);

  [[nodiscard]] bool empty() const { return distant_.empty() && nodes_.size() <= 1; }

  // The light if there is only one, else no_light.
  [[nodiscard]] LightId only() const { return only_; }

  // Returns nothing if no light is estimated to contribute. u is in [0, 1).
  [[nodiscard]] std::optional<LightChoice> choose(const LitPoint& at, float u) const;
  [[nodiscard]] float probability(const LitPoint& at, LightId light) const;

 private:
  static constexpr std::size_t most_in_cut = 64;

  struct Node {
    std::uint32_t parent = 0;
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;  // 0 marks a leaf
    LightId light = no_light;
  };
  // Nodes below another node that together hold all of its lights that may reach a point.
  struct Cut {
    std::array<std::uint32_t, most_in_cut> nodes;
    std::array<float, most_in_cut> importances;  // 0 where the node's children are listed instead
    std::uint32_t size = 0;
    float sum = 0;
  };

  void add_children(std::uint32_t parent, std::span<Placed> lights, int depth);
  // Opens groups breadth first, as far as the list has room.
  [[nodiscard]] Cut cut_below(std::uint32_t node, const LitPoint& at) const;

  LightId only_ = no_light;  // if there is just one, there is nothing to choose
  std::vector<Distant> distant_;
  std::vector<Node> nodes_;    // the first is the root
  std::vector<float> packed_;  // the bounds of the nodes, those of the children of one together
  std::vector<std::uint32_t> leaf_of_light_;
};

}  // namespace pah
