// Which light to ask: in proportion to an estimate of what each contributes at the shading point.
//
// The estimate is an unoccluded irradiance, so that the choice does not depend on the unit of
// length. Lights with a place stand in a binary tree whose nodes bound them; with few of them every
// leaf is asked, with many one child is chosen at a time. After Conty Estevez & Kulla, "Importance
// Sampling of Many Lights with Adaptive Tree Splitting" (HPG 2018), with the bounds of Pharr et
// al., Physically Based Rendering (4th ed.), 12.6.3.
#pragma once

#include <array>
#include <optional>
#include <pah/geometry/aabb.hpp>
#include <pah/scene/mesh.hpp>
#include <span>
#include <vector>

namespace pah {

// The point that is lit.
struct LitPoint {
  Vec3 position{0};
  Vec3 normal{0};          // of the shaded side, of unit length
  bool transmits = false;  // light from behind counts too
};

// Where a light, or a group of them, is, and where it shines: at angles up to theta_o from the
// axis in full, fading within a further theta_e.
struct LightBounds {
  Aabb box;
  Vec3 axis{0, 0, 1};
  float cos_theta_o = 1;
  float cos_theta_e = 1;
  bool two_sided = false;
  float intensity = 0;  // W/sr at the brightest, mean of the channels
};

// A light at infinity.
struct DistantBounds {
  Vec3 axis{0, 0, 1};    // towards the light, of unit length
  float angle = 0;       // half-angle of its cone, radians; pi: light from everywhere
  float irradiance = 0;  // on a surface that faces it, mean of the channels
};

// Upper bounds in shape, estimates in size: zero only where nothing arrives. W/m2.
[[nodiscard]] float importance(const LightBounds& bounds, const LitPoint& at);
[[nodiscard]] float importance(const DistantBounds& bounds, const LitPoint& at);

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
  // Lights without power are left out by the caller; each light occurs once, ids below `lights`.
  LightSampler(std::vector<Placed> placed, std::vector<Distant> distant, std::size_t lights);

  [[nodiscard]] bool empty() const { return distant_.empty() && nodes_.size() <= 1; }

  // The light to ask where there is no choice, or no_light.
  [[nodiscard]] LightId only() const { return only_; }

  // Nothing where no light is estimated to contribute. u in [0, 1).
  [[nodiscard]] std::optional<LightChoice> choose(const LitPoint& at, float u) const;
  [[nodiscard]] float probability(const LitPoint& at, LightId light) const;

 private:
  static constexpr std::size_t most_children = 64;

  struct Node {
    LightBounds bounds;
    std::uint32_t parent = 0;
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;  // 0 marks a leaf
    LightId light = no_light;
  };
  using Importances = std::array<float, most_children>;

  void add_children(std::uint32_t parent, std::span<Placed> lights, int depth);
  // Fills in the importance of each child; their sum.
  [[nodiscard]] float weigh_children(const Node& node, const LitPoint& at,
                                     Importances& importances) const;

  LightId only_ = no_light;  // if there is just one, there is nothing to choose
  std::vector<Distant> distant_;
  std::vector<Node> nodes_;  // the first is the root
  std::vector<std::uint32_t> leaf_of_light_;
};

}  // namespace pah
