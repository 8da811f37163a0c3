#include "render/light_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/spawn.hpp"

namespace pah {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Past a depth that no sane set of lights reaches groups are halved.
constexpr int max_unbalanced_depth = 16;

constexpr std::uint32_t not_a_leaf = 0xFFFFFFFFU;

// Leaves room to sum many of them.
constexpr float largest_importance = 1e30F;

float sine_of(float cosine) { return std::sqrt(std::max(0.0F, 1 - cosine * cosine)); }

// The cosine of max(0, a - b), and its sine, of angles in [0, pi].
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}

float safe_acos(float x) { return std::acos(std::clamp(x, -1.0F, 1.0F)); }

struct Cone {
  Vec3 axis;
  float cosine;
};

// The smallest cone that holds both.
Cone unite(const Cone& a, const Cone& b) {
  const float theta_a = safe_acos(a.cosine), theta_b = safe_acos(b.cosine);
  const float between = safe_acos(glm::dot(a.axis, b.axis));
  if (std::min(between + theta_b, pi) <= theta_a) return a;
  if (std::min(between + theta_a, pi) <= theta_b) return b;
  const float theta = (theta_a + between + theta_b) / 2;
  const Vec3 turn_axis = glm::cross(a.axis, b.axis);
  const float length = glm::length(turn_axis);
  if (theta >= pi || length == 0) return {a.axis, -1};
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

// What a node costs, by the surface area orientation heuristic. Points in a row span no area, so a
// little of the longest side counts as well.
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

// Sorts lights in two and tells how many are in the first part: at the best of some planes across
// the boxes' centers, in halves where all centers agree.
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

float importance(const LightBounds& bounds, const LitPoint& at) {
  if (bounds.intensity == 0) return 0;
  const Vec3 half = 0.5F * bounds.box.extent();
  const float radius2 = glm::dot(half, half);
  const Vec3 to_light = bounds.box.center() - at.position;
  const float center2 = glm::dot(to_light, to_light);
  // Within its own sphere a light's irradiance stops growing.
  const float falloff = 1 / std::max(center2, radius2);
  const float value = std::min(bounds.intensity * falloff, largest_importance);
  if (center2 <= radius2) return value;

  const Vec3 w = to_light / std::sqrt(center2);
  const float sin2_b = radius2 / center2;  // of the cone that the box's sphere fills
  const float sin_b = std::sqrt(sin2_b), cos_b = std::sqrt(1 - sin2_b);

  float cos_w = -glm::dot(bounds.axis, w);
  if (bounds.two_sided) cos_w = std::abs(cos_w);
  const float sin_w = sine_of(cos_w);
  const float sin_o = sine_of(bounds.cos_theta_o);
  const float cos_x = cos_of_difference(sin_w, cos_w, sin_o, bounds.cos_theta_o);
  const float sin_x = sin_of_difference(sin_w, cos_w, sin_o, bounds.cos_theta_o);
  const float cos_emission = cos_of_difference(sin_x, cos_x, sin_b, cos_b);
  if (cos_emission + rounding_bound(16) < bounds.cos_theta_e) return 0;

  float cos_i = glm::dot(w, at.normal);
  if (at.transmits) cos_i = std::abs(cos_i);
  const float cos_incidence = cos_of_difference(sine_of(cos_i), cos_i, sin_b, cos_b);
  if (cos_incidence <= 0) return 0;
  return value * std::max(cos_emission, 0.0F) * cos_incidence;
}

float importance(const DistantBounds& bounds, const LitPoint& at) {
  if (bounds.angle >= pi) return bounds.irradiance;
  float cos_i = glm::dot(bounds.axis, at.normal);
  if (at.transmits) cos_i = std::abs(cos_i);
  const float cosine =
      cos_of_difference(sine_of(cos_i), cos_i, std::sin(bounds.angle), std::cos(bounds.angle));
  return std::max(0.0F, cosine) * bounds.irradiance;
}

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

// Splits the largest group until there are as many as a node has children.
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
  if (lights.size() <= most_children) {
    for (std::size_t i = 0; i < lights.size(); ++i)
      groups.push_back(group_of(lights.subspan(i, 1)));
  } else {
    groups.push_back(group_of(lights));
    while (groups.size() < most_children) {
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
  for (const Group& group : groups) nodes_.push_back({group.bounds, parent});
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    if (groups[i].lights.size() > 1) {
      add_children(first + i, groups[i].lights, depth + 1);
    } else {
      nodes_[first + i].light = groups[i].lights.front().light;
      leaf_of_light_[nodes_[first + i].light] = first + i;
    }
  }
}

float LightSampler::weigh_children(const Node& node, const LitPoint& at,
                                   Importances& importances) const {
  float sum = 0;
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    importances[i] = importance(nodes_[node.first_child + i].bounds, at);
    sum += importances[i];
  }
  return sum;
}

std::optional<LightChoice> LightSampler::choose(const LitPoint& at, float u) const {
  if (only_ != no_light) return LightChoice{only_, 1};
  const Node* node = &nodes_.front();
  Importances importances;
  float total = weigh_children(*node, at, importances);
  for (const Distant& light : distant_) total += importance(light.bounds, at);
  if (!(total > 0)) return std::nullopt;

  // Walk through the estimates laid end to end; the last positive one catches rounding.
  float remaining = u * total;
  LightChoice choice;
  for (const Distant& light : distant_) {
    const float value = importance(light.bounds, at);
    if (!(value > 0)) continue;
    choice = {light.light, value / total};
    if (remaining < value) return choice;
    remaining -= value;
  }
  float probability = 1;
  for (;;) {
    const Node* chosen = nullptr;
    float value = 0;
    for (std::uint32_t i = 0; i < node->child_count; ++i) {
      if (!(importances[i] > 0)) continue;
      chosen = &nodes_[node->first_child + i];
      value = importances[i];
      if (remaining < value) break;
      remaining -= value;
    }
    if (chosen == nullptr) return choice;
    probability *= value / total;
    if (chosen->child_count == 0) return LightChoice{chosen->light, probability};
    const float rest = std::min(remaining / value, 0x1.fffffep-1F);
    node = chosen;
    total = weigh_children(*node, at, importances);
    if (!(total > 0)) return std::nullopt;
    remaining = rest * total;
  }
}

float LightSampler::probability(const LitPoint& at, LightId light) const {
  if (only_ != no_light) return light == only_ ? 1 : 0;
  Importances importances;
  float own = 0;
  float total = weigh_children(nodes_.front(), at, importances);
  for (const Distant& other : distant_) {
    const float value = importance(other.bounds, at);
    total += value;
    if (other.light == light) own = value;
  }
  if (!(total > 0)) return 0;
  if (own > 0) return own / total;
  if (leaf_of_light_[light] == not_a_leaf) return 0;
  float probability = 1;
  for (std::uint32_t index = leaf_of_light_[light]; index != 0; index = nodes_[index].parent) {
    const float value = importance(nodes_[index].bounds, at);
    if (!(value > 0)) return 0;
    const std::uint32_t parent = nodes_[index].parent;
    probability *= value / (parent == 0 ? total : weigh_children(nodes_[parent], at, importances));
  }
  return probability;
}

}  // namespace pah
