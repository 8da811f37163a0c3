#include "load/scene/keyframes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace pah {
namespace {

using Kind = YamlNode::Kind;

constexpr const char* title = "keyframes";

// M. Steffen, "A Simple Method for Monotonic Interpolation in One Dimension", 1990, eq. 11.
double slope_at(std::span<const Key> keys, std::size_t i) {
  if (i == 0 || i + 1 == keys.size()) return 0;  // at rest
  const double before = keys[i].at - keys[i - 1].at, after = keys[i + 1].at - keys[i].at;
  const double rise_before = (keys[i].value - keys[i - 1].value) / before;
  const double rise_after = (keys[i + 1].value - keys[i].value) / after;
  if (rise_before * rise_after <= 0) return 0;
  const double parabola = (rise_before * after + rise_after * before) / (before + after);
  const double least =
      std::min({std::abs(rise_before), std::abs(rise_after), std::abs(parabola) / 2});
  return std::copysign(2 * least, rise_before);
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
  if (!whole || !(std::abs(value) <= any_number.max)) return {};
  return value;
}

using Values = std::map<double, YamlRef>;  // by frame

// Interpolates numbers or lists of numbers, which must all have the shape of the first.
YamlRef blend(ReadContext& context, const Values& values, double frame,
              Interpolation interpolation) {
  const YamlNode& first = *values.begin()->second;
  auto result = std::make_shared<YamlNode>(first);
  if (first.kind == Kind::list) {
    for (const auto& [at, value] : values) {
      if (value->kind == Kind::list && value->items.size() == first.items.size()) continue;
      context.errors.add(value->mark, "a keyframe must be a list of " +
                                          std::to_string(first.items.size()) +
                                          " as the first one, not " + describe(*value));
      return nullptr;
    }
    for (std::size_t i = 0; i < first.items.size(); ++i) {
      Values items;
      for (const auto& [at, value] : values) items.emplace(at, value->items[i]);
      result->items[i] = blend(context, items, frame, interpolation);
      if (result->items[i] == nullptr) return nullptr;
    }
    return result;
  }
  std::vector<Key> keys;
  for (const auto& [at, value] : values) {
    Key key{at};
    if (!read_value(context, *value, "a keyframe", key.value)) return nullptr;
    keys.push_back(key);
  }
  result->number = interpolate(keys, frame, interpolation);
  result->text.clear();
  return result;
}

}  // namespace

double interpolate(std::span<const Key> keys, double at, Interpolation interpolation) {
  const auto next = std::ranges::upper_bound(keys, at, {}, &Key::at);
  if (next == keys.begin()) return keys.front().value;
  if (next == keys.end()) return keys.back().value;
  const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
  const Key &a = keys[i], &b = keys[i + 1];
  // Adds a difference, so that equal values stay equal to the last bit.
  const double width = b.at - a.at, rise = b.value - a.value, t = (at - a.at) / width, s = 1 - t;
  if (interpolation == Interpolation::linear) return a.value + t * rise;
  // Cubic Hermite interpolation.
  return a.value + t * t * (3 - 2 * t) * rise +
         width * t * s * (s * slope_at(keys, i) - t * slope_at(keys, i + 1));
}

bool is_keyframes(const YamlNode& map) {
  const YamlEntry* keys = map.find("keys");
  return keys != nullptr && keys->value->kind == Kind::map &&
         std::ranges::any_of(keys->value->entries, [](const YamlEntry& entry) {
           return number_of(entry.key).has_value();
         });
}

YamlRef read_keyframes(ReadContext& context, const YamlNode* node, double frame) {
  YamlRef result;
  read_map(context, node, title, title, [&](MapReader& map) {
    const YamlNode* keys = map.find("keys", true);
    Interpolation interpolation = Interpolation::linear;
    map.option("interpolation", interpolation,
               EnumNames<Interpolation>{{"linear", Interpolation::linear},
                                        {"smooth", Interpolation::smooth}});
    if (keys == nullptr) return;
    Values values;
    for (const YamlEntry& entry : keys->entries) {
      const std::optional<double> at = number_of(entry.key);
      if (!at)
        context.errors.add(entry.mark,
                           "keys of keyframes are frames: '" + entry.key + "' is not a number");
      else if (!values.emplace(*at, entry.value).second)
        context.errors.add(entry.mark, "the frame " + entry.key + " has two keyframes");
    }
    result = blend(context, values, frame, interpolation);
  });
  return result;
}

}  // namespace pah
