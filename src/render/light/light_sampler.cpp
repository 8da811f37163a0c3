#include "render/light/light_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pah {
namespace {

using std::numbers::pi_v;

// Up to few_lights are weighed one by one. More lights are divided into groups, and these again
// until they are small, so that whole groups can be ruled out.
constexpr std::size_t few_lights = 64, small_group = 16, most_groups = 8;

// Beyond this depth, which ordinary sets of lights never reach, groups are halved.
constexpr int max_unbalanced_depth = 16;

constexpr std::uint32_t not_a_leaf = 0xFFFFFFFFU;

float safe_acos(float x) { return std::acos(std::clamp(x, -1.0F, 1.0F)); }

struct Cone {
  Vec3 axis;
  float cosine;
};

// The smallest cone that holds both.
Cone unite(const Cone& a, const Cone& b) {
  const float theta_a = safe_acos(a.cosine), theta_b = safe_acos(b.cosine);
  const float between = safe_acos(glm::dot(a.axis, b.axis));
  if (std::min(between + theta_b, pi_v<float>) <= theta_a) return a;
  if (std::min(between + theta_a, pi_v<float>) <= theta_b) return b;
  const float theta = (theta_a + between + theta_b) / 2;
  const Vec3 turn_axis = glm::cross(a.axis, b.axis);
  const float length = glm::length(turn_axis);
  if (theta >= pi_v<float> || length == 0) return {a.axis, -1};
  const float turn = theta - theta_a;
  const Vec3 across = glm::cross(turn_axis / length, a.axis);
  return {glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * across), std::cos(theta)};
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
  if (a.intensity == 0) return b;
  if (b.intensity == 0) return a;
  const Cone cone = unite(Cone{a.axis, a.cos_theta_o}, Cone{b.axis, b.cos_theta_o});
  LightBounds united = a;
  united.box.extend(b.box);
  united.axis = cone.axis;
  united.cos_theta_o = cone.cosine;
  united.cos_theta_e = std::min(a.cos_theta_e, b.cos_theta_e);
  united.two_sided = a.two_sided || b.two_sided;
  united.intensity = a.intensity + b.intensity;
  return united;
}

// The cost of a node by the surface area orientation heuristic. A part of the longest side is
// added, because points in a row span no surface.
double split_cost(const LightBounds& bounds) {
  const double theta_o = std::acos(std::clamp(static_cast<double>(bounds.cos_theta_o), -1.0, 1.0));
  const double theta_e = std::acos(std::clamp(static_cast<double>(bounds.cos_theta_e), -1.0, 1.0));
  const double theta_w = std::min(theta_o + theta_e, std::numbers::pi);
  const double orientation =
      2 * std::numbers::pi * (1 - std::cos(theta_o)) +
      std::numbers::pi / 2 *
          (2 * theta_w * std::sin(theta_o) - std::cos(theta_o - 2 * theta_w) -
           2 * theta_o * std::sin(theta_o) + std::cos(theta_o));
  const DVec3 e(bounds.box.extent());
  const double longest = std::max({e.x, e.y, e.z});
  const double area = e.x * e.y + e.y * e.z + e.z * e.x + 0.01 * longest * longest;
  return static_cast<double>(bounds.intensity) * orientation * area;
}

// Partitions lights at the best of some planes across the boxes' centers, or in halves if all
// centers agree. Returns the size of the first part.
std::size_t split(std::span<LightSampler::Placed> lights) {
  constexpr int bucket_count = 12;
  Aabb centers;
  for (const LightSampler::Placed& light : lights) centers.extend(light.bounds.box.center());
  const auto bucket_of = [&](const LightSampler::Placed& light, int axis) {
    const float relative =
        (light.bounds.box.center()[axis] - centers.min[axis]) / centers.extent()[axis];
    return std::clamp(static_cast<int>(relative * bucket_count), 0, bucket_count - 1);
  };
  double best = std::numeric_limits<double>::infinity();
  int best_axis = -1, best_bucket = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centers.extent()[axis] > 0)) continue;
    std::array<LightBounds, bucket_count> buckets{};
    for (const LightSampler::Placed& light : lights) {
      LightBounds& bucket = buckets[static_cast<std::size_t>(bucket_of(light, axis))];
      bucket = unite(bucket, light.bounds);
    }
    std::array<double, bucket_count> below{};
    LightBounds running;
    for (std::size_t i = 0; i + 1 < bucket_count; ++i) {
      running = unite(running, buckets[i]);
      below[i] = running.intensity > 0 ? split_cost(running) : 0;
    }
    running = {};
    for (std::size_t i = bucket_count - 1; i > 0; --i) {
      running = unite(running, buckets[i]);
      const double cost = below[i - 1] + (running.intensity > 0 ? split_cost(running) : 0);
      if (cost < best) {
        best = cost;
        best_axis = axis;
        best_bucket = static_cast<int>(i);
      }
    }
  }
  if (best_axis < 0) return lights.size() / 2;
  const auto above = std::stable_partition(
      lights.begin(), lights.end(),
      [&](const LightSampler::Placed& light) { return bucket_of(light, best_axis) < best_bucket; });
  const auto below = static_cast<std::size_t>(above - lights.begin());
  return below > 0 && below < lights.size() ? below : lights.size() / 2;
}

}  // namespace

LightSampler::LightSampler(std::vector<Placed> placed, std::vector<Distant> distant,
                           std::size_t lights)
    : distant_(std::move(distant)) {
  if (placed.size() + distant_.size() == 1) {
    only_ = distant_.empty() ? placed.front().light : distant_.front().light;
  }
  leaf_of_light_.assign(lights, not_a_leaf);
  nodes_.emplace_back();
  add_children(0, placed, 0);
}

// Splits the costliest group until a node has its full number of children.
void LightSampler::add_children(std::uint32_t parent, std::span<Placed> lights, int depth) {
  struct Group {
    std::span<Placed> lights;
    LightBounds bounds;
    double cost = 0;  // 0: not to be split
  };
  const auto group_of = [](std::span<Placed> members) {
    Group group{members, members.front().bounds};
    if (members.size() > 1) {
      for (const Placed& light : members.subspan(1)) {
        group.bounds = unite(group.bounds, light.bounds);
      }
      group.cost = std::max(split_cost(group.bounds), std::numeric_limits<double>::min());
    }
    return group;
  };
  std::vector<Group> groups;
  if (lights.size() <= (parent == 0 ? few_lights : small_group)) {
    for (std::size_t i = 0; i < lights.size(); ++i)
      groups.push_back(group_of(lights.subspan(i, 1)));
  } else {
    groups.push_back(group_of(lights));
    while (groups.size() < most_groups) {
      const auto largest = std::ranges::max_element(groups, {}, &Group::cost);
      const std::span<Placed> members = largest->lights;
      const std::size_t middle = depth < max_unbalanced_depth ? split(members) : members.size() / 2;
      *largest = group_of(members.subspan(0, middle));
      groups.push_back(group_of(members.subspan(middle)));
    }
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[parent].first_child = first;
  nodes_[parent].child_count = static_cast<std::uint32_t>(groups.size());
  nodes_.resize(first + groups.size());
  packed_.resize(packed_size * nodes_.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    pack(groups[i].bounds, i, std::span(packed_).subspan(packed_size * first));
  }
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    nodes_[first + i].parent = parent;
    if (groups[i].lights.size() > 1) {
      add_children(first + i, groups[i].lights, depth + 1);
    } else {
      nodes_[first + i].light = groups[i].lights.front().light;
      leaf_of_light_[nodes_[first + i].light] = first + i;
    }
  }
}

LightSampler::Cut LightSampler::cut_below(std::uint32_t node, const LitPoint& at) const {
  Cut cut;
  const auto open = [&](const Node& opened) {
    std::array<float, few_lights> values;
    const std::size_t count = opened.child_count;
    importances(std::span(packed_).subspan(packed_size * opened.first_child, packed_size * count),
                at, values.data());
    for (std::uint32_t child = 0; child < count; ++child) {
      const float value = values[child];
      if (!(value > 0)) continue;
      cut.nodes[cut.size] = opened.first_child + child;
      cut.importances[cut.size] = value;
      ++cut.size;
    }
  };
  open(nodes_[node]);
  for (std::uint32_t i = 0; i < cut.size; ++i) {
    const Node& group = nodes_[cut.nodes[i]];
    if (group.child_count == 0 || cut.size + group.child_count > cut.nodes.size()) continue;
    cut.importances[i] = 0;
    open(group);
  }
  for (std::uint32_t i = 0; i < cut.size; ++i) cut.sum += cut.importances[i];
  return cut;
}

std::optional<LightChoice> LightSampler::choose(const LitPoint& at, float u) const {
  if (only_ != no_light) return LightChoice{only_, 1};
  Cut cut = cut_below(0, at);
  float total = cut.sum;
  for (const Distant& light : distant_) total += importance(light.bounds, at);
  if (!(total > 0)) return std::nullopt;

  // Searches the prefix sums of the estimates; the last positive one catches rounding.
  float remaining = u * total;
  LightChoice choice;
  for (const Distant& light : distant_) {
    const float value = importance(light.bounds, at);
    if (!(value > 0)) continue;
    choice = {light.light, value / total};
    if (remaining < value) return choice;
    remaining -= value;
  }
  if (!(cut.sum > 0)) return choice;
  float probability = 1;
  for (;;) {
    std::uint32_t chosen = 0;
    float value = 0;
    for (std::uint32_t i = 0; i < cut.size; ++i) {
      if (!(cut.importances[i] > 0)) continue;
      chosen = cut.nodes[i];
      value = cut.importances[i];
      if (remaining < value) break;
      remaining -= value;
    }
    probability *= value / total;
    if (nodes_[chosen].child_count == 0) return LightChoice{nodes_[chosen].light, probability};
    cut = cut_below(chosen, at);
    total = cut.sum;
    if (!(total > 0)) return std::nullopt;
    remaining = std::min(remaining / value, 0x1.fffffep-1F) * total;
  }
}

float LightSampler::probability(const LitPoint& at, LightId light) const {
  if (only_ != no_light) return light == only_ ? 1 : 0;
  Cut cut = cut_below(0, at);
  float total = cut.sum, own = 0;
  for (const Distant& other : distant_) {
    const float value = importance(other.bounds, at);
    total += value;
    if (other.light == light) own = value;
  }
  if (!(total > 0)) return 0;
  if (own > 0) return own / total;
  const std::uint32_t leaf = leaf_of_light_[light];
  if (leaf == not_a_leaf) return 0;
  float probability = 1;
  for (;;) {
    // The node of the cut that holds the light.
    std::uint32_t holder = leaf;
    float value = 0;
    for (std::uint32_t index = leaf; index != 0 && value == 0; index = nodes_[index].parent) {
      for (std::uint32_t i = 0; i < cut.size; ++i) {
        if (cut.nodes[i] == index && cut.importances[i] > 0) {
          holder = index;
          value = cut.importances[i];
        }
      }
    }
    if (value == 0) return 0;
    probability *= value / total;
    if (holder == leaf) return probability;
    cut = cut_below(holder, at);
    total = cut.sum;
  }
}

}  // namespace pah
