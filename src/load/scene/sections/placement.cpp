// Reads the placement of copies of a mesh.
#include <fmt/format.h>

#include <algorithm>
#include <pah/scene/placement.hpp>

#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

using Transforms = std::vector<glm::dmat4x3>;
constexpr std::uint32_t most_copies = 0xFFFFFFFFU;

// Combines every transform of `outer` with every one of `inner`; reports an error if there are too
// many.
Transforms combine(SceneReading& reading, const Mark& mark, const Transforms& outer,
                   const Transforms& inner) {
  if (outer.size() * inner.size() > reading.limits.instances) {
    reading.context.errors.add(
        mark, "more than " + std::to_string(reading.limits.instances) + " instances");
    return inner;
  }
  Transforms result;
  result.reserve(outer.size() * inner.size());
  for (const auto& c_from_b : outer)
    for (const auto& b_from_a : inner) result.push_back(compose(c_from_b, b_from_a));
  return result;
}

bool check_count(SceneReading& reading, const Mark& mark, std::uint64_t count) {
  const std::uint64_t room =
      reading.limits.instances -
      std::min<std::uint64_t>(reading.scene.instances.size(), reading.limits.instances);
  if (count <= room) return true;
  reading.context.errors.add(
      mark, "more than " + std::to_string(reading.limits.instances) + " instances in the scene");
  return false;
}

// Applies the pattern's own transform to the copies.
Transforms moved(ReadContext& context, MapReader& map, Transforms copies) {
  map.nested("transform", [&](const YamlNode* node) {
    const glm::dmat4x3 outer(read_transform(context, node, map.title()));
    for (auto& copy : copies) copy = compose(outer, copy);
  });
  return copies;
}

Transforms read_repeat(SceneReading& reading, const YamlNode* node, const std::string& title) {
  Transforms copies{glm::dmat4x3(1.0)};
  read_variant(reading.context, node, "repeat", "repeat of " + title, "type",
               {"line", "grid", "ring"}, 3, [&](MapReader& map, std::size_t type) {
                 Repeat repeat;
                 bool valid = true;
                 if (type == 0) {
                   LineRepeat line;
                   const bool has_count = map.required("count", line.count, 1U, most_copies);
                   const bool has_step = map.required("step", line.step);
                   valid = has_count && has_step;
                   repeat = line;
                 } else if (type == 1) {
                   GridRepeat grid;
                   DVec3 count{1};
                   if (map.required("count", count, NumberRange{1, most_copies})) {
                     grid.count = UVec3(count);
                     valid = DVec3(grid.count) == count;
                     if (!valid)
                       map.error("count", map.name_of("count") + " must be whole numbers");
                   } else {
                     valid = false;
                   }
                   map.optional("step", grid.step);
                   map.optional("centered", grid.centered);
                   repeat = grid;
                 } else {
                   RingRepeat ring;
                   valid = map.required("count", ring.count, 1U, most_copies);
                   map.optional("radius", ring.radius, not_negative);
                   map.optional("start", ring.start);
                   map.optional("turn", ring.turn);
                   repeat = ring;
                 }
                 if (!map.recording() && valid &&
                     check_count(reading, map.mark_of("count"), count_of(repeat)))
                   copies = place(repeat);
                 copies = moved(reading.context, map, std::move(copies));
               });
  return copies;
}

bool read_scale_range(MapReader& map, DVec2& scale) {
  const YamlNode* node = map.find("scale");
  if (node == nullptr) return true;
  const ValueName name = map.name_of("scale");
  if (node->kind == YamlNode::Kind::list) {
    if (!read_value(map.context(), *node, name, scale, positive)) return false;
    if (scale.x <= scale.y) return true;
    map.error("scale", name + " must rise: [smallest, largest]");
    return false;
  }
  double factor = 1;
  if (!read_value(map.context(), *node, name, factor, positive)) return false;
  scale = DVec2(factor);
  return true;
}

Transforms read_scatter(SceneReading& reading, const YamlNode* node, const std::string& title) {
  Transforms copies{glm::dmat4x3(1.0)};
  read_map(reading.context, node, "scatter", "scatter of " + title, [&](MapReader& map) {
    ScatterOptions options;
    DVec2 size{1};
    bool valid = map.required("count", options.count, 1U, most_copies);
    map.optional("seed", options.seed);
    map.optional("turn", options.turn);
    valid = read_scale_range(map, options.scale) && valid;
    map.optional("min_distance", options.min_distance, not_negative);
    map.optional("align", options.align);
    const bool sized = map.optional("size", size, positive);
    const YamlNode* over = map.find("over");
    valid = valid && (map.recording() || check_count(reading, map.mark_of("count"), options.count));
    if (over != nullptr) {
      if (sized) map.error("over", map.title() + " takes either 'size' or 'over'");
      const auto id = reading.meshes.find(reading.context, *over, map.name_of("over"));
      if (id && reading.first_instances[*id] < reading.scene.instances.size() && valid) {
        const Instance& instance = reading.scene.instances[reading.first_instances[*id]];
        copies = scatter(reading.scene.meshes[instance.mesh], instance.world_from_object, options);
      }
    } else if (!map.recording() && valid) {
      copies = scatter(size, options);
    }
    if (options.min_distance > 0 && valid && copies.size() < options.count && !map.recording())
      reading.context.errors.warn(map.mark_of("count"),
                                  fmt::format("only {} of {} copies fit at this 'min_distance'",
                                              copies.size(), options.count));
    copies = moved(reading.context, map, std::move(copies));
  });
  return copies;
}

}  // namespace

Transforms read_placement(SceneReading& reading, MapReader& map) {
  Transforms copies{glm::dmat4x3(1.0)};
  map.nested("transform", [&](const YamlNode* node) {
    copies.front() = glm::dmat4x3(read_transform(reading.context, node, map.title()));
  });
  map.nested("repeat", [&](const YamlNode* node) {
    const auto apply = [&](const YamlNode* one) {
      copies = combine(reading, one == nullptr ? Mark{} : one->mark,
                       read_repeat(reading, one, map.title()), copies);
    };
    if (node == nullptr || node->kind != YamlNode::Kind::list) return apply(node);
    for (const YamlRef& item : node->items) apply(item.get());
  });
  map.nested("scatter", [&](const YamlNode* node) {
    copies = combine(reading, node == nullptr ? Mark{} : node->mark,
                     read_scatter(reading, node, map.title()), copies);
  });
  return copies;
}

}  // namespace pah
