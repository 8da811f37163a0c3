// The acceleration section.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>

#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

struct Unit {
  std::string_view name;
  double bytes;
};

constexpr std::array<Unit, 9> units{{{"B", 1},
                                     {"KiB", 0x1p10},
                                     {"MiB", 0x1p20},
                                     {"GiB", 0x1p30},
                                     {"TiB", 0x1p40},
                                     {"KB", 1e3},
                                     {"MB", 1e6},
                                     {"GB", 1e9},
                                     {"TB", 1e12}}};

bool is_same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(a, b, {}, lower, lower);
}

// Parses "2 GiB" or "1.5gb": a number, then a unit in upper or lower case.
std::optional<std::uint64_t> parse_bytes(std::string_view text) {
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  double number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc() || number <= 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const auto unit = std::ranges::find_if(
      units, [&](const Unit& known) { return is_same_word(known.name, text); });
  if (unit == units.end()) return std::nullopt;
  const double bytes = std::ceil(number * unit->bytes);
  // Saturates: no memory is larger than the address space.
  return bytes < 0x1p64 ? static_cast<std::uint64_t>(bytes) : UINT64_MAX;
}

void read_bytes(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::optional<std::uint64_t>& value) {
  const auto bytes = node.kind == YamlNode::Kind::scalar ? parse_bytes(node.text) : std::nullopt;
  if (bytes) {
    value = bytes;
    return;
  }
  std::string known;
  for (const Unit& unit : units) known += (known.empty() ? "" : ", ") + std::string(unit.name);
  context.errors.add(node.mark, name + " must be a number greater than 0 and a unit (" + known +
                                    "), such as '2 GiB', not " + describe(node));
}

constexpr NumberRange ratio_range{0, 2, false, false};
constexpr std::uint32_t most_levels = 48;  // deeper nodes are split in halves anyway

void read_leaf_rules(MapReader& map, LeafRules& rules) {
  map.optional("max_leaf_cost", rules.cost, not_negative);
  map.optional("max_leaf_area", rules.area, not_negative);
  map.optional("max_leaf_probability", rules.probability, unit_range);
  map.optional("min_inner_triangles", rules.triangles, 0U, BuildConfig::most_leaf);
  map.optional("max_levels", rules.levels, 0U, most_levels);
}

void read_top_level(MapReader& map, TopLevelConfig& config) {
  map.option("top_level", config.kind, names_of<TopLevelKind>(top_level_names));
  map.optional("octree_depth", config.octree_depth, 0, 10);
  double degrees = 0;
  if (map.optional("direction_tolerance", degrees, NumberRange{0, 180, false, false}))
    config.direction_tolerance = glm::radians(degrees);
}

}  // namespace

void read_acceleration(SceneReading& reading, const YamlNode* node) {
  AccelerationSettings& settings = reading.scene.acceleration;
  LocalConfig& local = settings.local;
  read_map(reading.context, node, "acceleration", "acceleration", [&](MapReader& map) {
    EnumNames<Heuristic> heuristics = names_of<Heuristic>(heuristic_names);
    heuristics.insert(heuristics.begin(), {"auto", LocalConfig{}.heuristic});
    map.option("heuristic", local.heuristic, heuristics);
    map.option("split_axis", local.split, names_of<SplitAxis>(split_axis_names));
    map.optional("bins", local.build.bins, BuildConfig::min_bins, BuildConfig::max_bins);
    map.optional("max_leaf_triangles", local.build.max_leaf, 1U, BuildConfig::most_leaf);
    map.optional("least_share", local.build.least_share, NumberRange{0, 0.5, false, false});
    read_leaf_rules(map, local.build.leaves);
    map.optional("facing_threshold", local.facing.threshold, unit_range);
    map.optional("acceptable_ratio", local.facing.acceptable_ratio, ratio_range);
    map.optional("excellent_ratio", local.facing.excellent_ratio, ratio_range);
    map.optional("non_fallback_levels", local.non_fallback_levels, 0U, most_levels);
    read_top_level(map, local.top_level);
    if (const YamlNode* memory = map.find("memory"))
      read_bytes(reading.context, *memory, map.name_of("memory"), settings.memory);
  });
}

}  // namespace pah
