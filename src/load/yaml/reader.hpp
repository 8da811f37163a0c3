// Reads maps of a YAML tree into values, and checks types, ranges, names, missing and unknown keys.
//
// The reading code is the only description of the language: run without a document and with a
// Language to fill in, it lists the keys of every kind of map (see describe_language()).
#pragma once

#include <array>
#include <functional>
#include <map>
#include <pah/base/enum_names.hpp>
#include <pah/geometry/vec.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "load/yaml/error_collector.hpp"
#include "load/yaml/tree.hpp"

namespace pah {

// Properties of a key.
struct KeyDescription {
  bool required = false;
  std::vector<std::string> options;  // if the value is one of a few words
};
// Keys by kind of map, such as "material diffuse".
using Language = std::map<std::string, std::map<std::string, KeyDescription>>;

struct ReadContext {
  ErrorCollector& errors;
  Language* language = nullptr;  // if set: nothing is read, every kind is described
  // Returns a hint for the message of an unknown key, given the known keys; may be empty.
  std::string (*hint)(std::string_view key, const std::vector<std::string>& known) = nullptr;
};

// The range of a number.
struct NumberRange {
  double min = -1e18;  // squares of all numbers in a scene are finite floats
  double max = 1e18;
  bool min_open = false;
  bool max_open = false;
};
inline constexpr NumberRange any_number{};
inline constexpr NumberRange positive{0, 1e18, true, false};
inline constexpr NumberRange not_negative{0, 1e18, false, false};
inline constexpr NumberRange unit_range{0, 1, false, false};

// Describes a value's place in words: "'fov' of camera".
using ValueName = std::string;

// Describes a value: "3", "'abc'", "a list of 2", "a map", "nothing".
[[nodiscard]] std::string describe(const YamlNode& node);
[[nodiscard]] bool is_number(const YamlNode& node);

// Each reports errors and then returns false with `value` unchanged.
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, double& value,
                const NumberRange& range = any_number);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, float& value,
                const NumberRange& range = any_number);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, int& value,
                int min, int max);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::uint32_t& value, std::uint32_t min, std::uint32_t max);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::uint64_t& value);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, bool& value);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::string& value);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, DVec2& value,
                const NumberRange& range = any_number);
bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, DVec3& value,
                const NumberRange& range = any_number);
// Reads a list of exactly `count` numbers.
bool read_numbers(ReadContext& context, const YamlNode& node, const ValueName& name, double* values,
                  std::size_t count, const NumberRange& range = any_number);

// Returns the index of the text in `options`, or reports an error and returns options.size().
std::size_t read_option(ReadContext& context, const YamlNode& node, const ValueName& name,
                        const std::vector<std::string>& options);

// Names of an enumeration's values, in order.
template <class Enum>
using EnumNames = std::vector<std::pair<std::string, Enum>>;
template <typename Enum>
[[nodiscard]] EnumNames<Enum> names_of(std::span<const EnumName<Enum>> names) {
  EnumNames<Enum> keys;
  for (const EnumName<Enum>& name : names) keys.emplace_back(name.key, name.value);
  return keys;
}

class MapReader {
 public:
  // `kind` names the kind of map in the language ("material diffuse"), `title` this map ("material
  // 'white'"). Without a node, every key is absent.
  MapReader(ReadContext& context, const YamlNode* node, std::string kind, std::string title)
      : context_(context), node_(node), kind_(std::move(kind)), title_(std::move(title)) {
    if (recording()) (*context_.language)[kind_];
  }

  [[nodiscard]] bool recording() const { return context_.language != nullptr; }
  [[nodiscard]] ReadContext& context() const { return context_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] Mark mark() const { return node_ == nullptr ? Mark{} : node_->mark; }
  // Returns the place of a key's value, or of the map if the key is absent.
  [[nodiscard]] Mark mark_of(std::string_view key) const;
  [[nodiscard]] ValueName name_of(std::string_view key) const {
    return "'" + std::string(key) + "' of " + title_;
  }

  // Returns the key's value or null, and registers the key.
  const YamlNode* find(std::string_view key, bool required = false,
                       const std::vector<std::string>& options = {});

  // Returns false with `value` unchanged if the key is absent or its value is wrong.
  template <class T, class... Limits>
  bool optional(std::string_view key, T& value, const Limits&... limits) {
    const YamlNode* node = find(key);
    return node != nullptr && read_value(context_, *node, name_of(key), value, limits...);
  }
  template <class T, class... Limits>
  bool required(std::string_view key, T& value, const Limits&... limits) {
    const YamlNode* node = find(key, true);
    return node != nullptr && read_value(context_, *node, name_of(key), value, limits...);
  }
  template <class Enum>
  bool option(std::string_view key, Enum& value, const EnumNames<Enum>& names,
              bool is_required = false) {
    std::vector<std::string> options;
    for (const auto& [name, unused] : names) options.push_back(name);
    const YamlNode* node = find(key, is_required, options);
    if (node == nullptr) return false;
    const std::size_t index = read_option(context_, *node, name_of(key), options);
    if (index < names.size()) value = names[index].second;
    return index < names.size();
  }
  // Calls read(node) if the key is present, or read(nullptr) while describing the language.
  template <class Read>
  void nested(std::string_view key, Read&& read, bool is_required = false) {
    const YamlNode* node = find(key, is_required);
    if (node != nullptr || recording()) read(node);
  }

  void error(std::string_view key, std::string message) const {
    context_.errors.add(mark_of(key), std::move(message));
  }

  // Describes, for the language, the kind of map that this one becomes with `branch`. It has all
  // keys registered so far. This kind itself then no longer exists.
  template <class Read>
  void describe_branch(const std::string& branch, Read&& read) {
    MapReader reader(context_, nullptr, kind_ + " " + branch, title_);
    if (!known_.empty()) common_ = (*context_.language)[kind_];
    known_.clear();
    context_.language->erase(kind_);
    (*context_.language)[reader.kind_] = common_;
    read(reader);
  }

  // Makes finish() accept all keys, because without a valid type the right keys are unknown.
  void ignore_other_keys() { keys_known_ = false; }
  // Reports unknown keys.
  void finish() const;

 private:
  ReadContext& context_;
  const YamlNode* node_;
  std::string kind_;
  std::string title_;
  std::vector<std::string> known_;
  bool keys_known_ = true;
  std::map<std::string, KeyDescription> common_;
};

// Reports an error and returns false if the node exists and is not a map.
bool is_map(ReadContext& context, const YamlNode* node, const std::string& title);
bool is_list(ReadContext& context, const YamlNode& node, const std::string& title);

// Calls read(MapReader&) for a map of one kind.
template <class Read>
void read_map(ReadContext& context, const YamlNode* node, const std::string& kind,
              const std::string& title, Read&& read) {
  if (!is_map(context, node, title)) return;
  MapReader reader(context, node, kind, title);
  read(reader);
  reader.finish();
}

// Calls read(MapReader&, index of the option) for a map whose `key` selects its kind. Without the
// key, the option is `fallback`, or an error if that is out of range.
template <class Read>
void read_variant(ReadContext& context, const YamlNode* node, const std::string& kind,
                  const std::string& title, std::string_view key,
                  const std::vector<std::string>& options, std::size_t fallback, Read&& read) {
  if (!is_map(context, node, title)) return;
  const bool key_required = fallback >= options.size();
  if (context.language != nullptr) {
    for (std::size_t i = 0; i < options.size(); ++i) {
      MapReader reader(context, nullptr, kind + " " + options[i], title);
      reader.find(key, i != fallback, {options[i]});
      read(reader, i);
    }
    return;
  }
  MapReader reader(context, node, kind, title);
  const YamlNode* value = reader.find(key, key_required, options);
  if (value == nullptr && key_required) return;
  const std::size_t index =
      value == nullptr ? fallback : read_option(context, *value, reader.name_of(key), options);
  if (index >= options.size()) return;
  read(reader, index);
  reader.finish();
}

}  // namespace pah
