#include "load/yaml/reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "load/yaml/expression.hpp"
#include "load/yaml/hints.hpp"
#include "load/yaml/suggest.hpp"

namespace pah {
namespace {

// Names a key that is similar to the missing one, or the possible values.
std::string missing_hint(const YamlNode* node, std::string_view key,
                         const std::vector<std::string>& options) {
  if (node != nullptr)
    for (const YamlEntry& entry : node->entries)
      if (edit_distance(entry.key, key) == 1)
        return "; is '" + entry.key + "' meant to be '" + std::string(key) + "'?";
  return suggestion_and_options("", options);
}

using Kind = YamlNode::Kind;

enum class NumberFault { none, not_a_number, not_finite, out_of_range };

NumberFault parse_number(const YamlNode& node, double& value) {
  if (node.kind != Kind::scalar || node.quoted) return NumberFault::not_a_number;
  if (node.number) {
    value = *node.number;
    return std::isfinite(value) ? NumberFault::none : NumberFault::not_finite;
  }
  std::string text = node.text;
  if (!text.empty() && text.front() == '+') text.erase(0, 1);
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (!lower.empty() && lower.front() == '-') lower.erase(0, 1);
  for (const char* word : {".inf", ".nan", "inf", "nan", "infinity"})
    if (lower == word) return NumberFault::not_finite;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument || text.empty())
    return NumberFault::not_a_number;
  if (error != std::errc()) return NumberFault::out_of_range;
  return std::isfinite(value) ? NumberFault::none : NumberFault::not_a_number;
}

std::string format_number(double value) {
  std::array<char, 64> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string describe_range(const NumberRange& range) {
  const std::string min = format_number(range.min), max = format_number(range.max);
  if (range.max >= any_number.max && range.min > any_number.min)
    return range.min_open ? "greater than " + min : "at least " + min;
  if (range.min <= any_number.min && range.max >= any_number.max)
    return "between " + min + " and " + max;
  if (range.min_open || range.max_open)
    return (range.min_open ? "greater than " : "at least ") + min + " and " +
           (range.max_open ? "less than " : "at most ") + max;
  return "between " + min + " and " + max;
}

bool in_range(double value, const NumberRange& range) {
  return (range.min_open ? value > range.min : value >= range.min) &&
         (range.max_open ? value < range.max : value <= range.max);
}

// Reads a number, alone or in a list.
bool read_number(ReadContext& context, const YamlNode& node, const ValueName& name, double& value,
                 const NumberRange& range) {
  double number = 0;
  const NumberFault fault = parse_number(node, number);
  std::string wanted;
  if (fault == NumberFault::not_a_number) wanted = "a number";
  if (fault == NumberFault::not_finite) wanted = "a finite number";
  const bool outside = fault == NumberFault::none && !in_range(number, range);
  if (fault == NumberFault::out_of_range || outside) {
    // For a number beyond all limits, the range of this value does not help.
    const bool huge = fault == NumberFault::out_of_range || std::abs(number) > any_number.max;
    wanted = describe_range(huge && !(range.max < any_number.max) ? any_number : range);
  }
  if (wanted.empty()) {
    value = number;
    return true;
  }
  std::string hint;
  if (fault == NumberFault::not_a_number && node.kind == Kind::scalar && !node.quoted)
    hint = suggestion(unknown_name_in(node.text), expression_names());
  context.errors.add(node.mark, name + " must be " + wanted + ", not " + describe(node) + hint);
  return false;
}

template <class Integer>
bool read_integer(ReadContext& context, const YamlNode& node, const ValueName& name, Integer& value,
                  Integer min, Integer max) {
  double number = 0;
  Integer exact{};
  const std::string_view text = node.text;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exact);
  const bool is_exact = node.kind == Kind::scalar && !node.quoted && error == std::errc() &&
                        end == text.data() + text.size() && !text.empty();
  const NumberFault fault = parse_number(node, number);
  // Up to 2^53, doubles represent every whole number. 1e3 counts as one.
  const bool whole = is_exact || (fault == NumberFault::none && number == std::floor(number) &&
                                  std::abs(number) <= 9007199254740992.0);
  const bool fits = is_exact
                        ? exact >= min && exact <= max
                        : number >= static_cast<double>(min) && number <= static_cast<double>(max);
  if (whole && fits) {
    value = is_exact ? exact : static_cast<Integer>(number);
    return true;
  }
  const bool looks_whole = whole || fault == NumberFault::out_of_range ||
                           (fault == NumberFault::none && number == std::floor(number));
  std::string wanted = "a whole number";
  if (looks_whole) wanted += " between " + std::to_string(min) + " and " + std::to_string(max);
  context.errors.add(node.mark, name + " must be " + wanted + ", not " + describe(node));
  return false;
}

}  // namespace

std::string describe(const YamlNode& node) {
  if (node.kind == Kind::null) return "nothing";
  if (node.kind == Kind::list) return "a list of " + std::to_string(node.items.size());
  if (node.kind == Kind::map) return "a map";
  if (node.number) {
    const std::string number = format_number(*node.number);
    return node.text.empty() ? number : number + ", which is " + node.text;
  }
  constexpr std::size_t longest = 60;
  std::string text = node.text.substr(0, longest);
  while (!text.empty() && text.size() < node.text.size() &&
         (static_cast<unsigned char>(node.text[text.size()]) & 0xC0U) == 0x80)
    text.pop_back();
  if (text.size() < node.text.size()) text += "...";
  return is_number(node) ? text : "'" + text + "'";
}

bool is_number(const YamlNode& node) {
  double unused = 0;
  return parse_number(node, unused) != NumberFault::not_a_number;
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, double& value,
                const NumberRange& range) {
  return read_number(context, node, name, value, range);
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, float& value,
                const NumberRange& range) {
  double number = value;
  if (!read_number(context, node, name, number, range)) return false;
  const auto rounded = static_cast<float>(number);
  if (in_range(rounded, range)) {
    value = rounded;
    return true;
  }
  context.errors.add(node.mark, name + " must be " + describe_range(range) + ", not " +
                                    describe(node) + ", which a float cannot tell from the bound");
  return false;
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, int& value,
                int min, int max) {
  return read_integer(context, node, name, value, min, max);
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::uint32_t& value, std::uint32_t min, std::uint32_t max) {
  return read_integer(context, node, name, value, min, max);
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::uint64_t& value) {
  return read_integer(context, node, name, value, std::uint64_t{0},
                      std::numeric_limits<std::uint64_t>::max());
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, bool& value) {
  if (node.kind == Kind::scalar && !node.quoted) {
    if (node.text == "true" || node.text == "True" || node.text == "TRUE") return value = true;
    if (node.text == "false" || node.text == "False" || node.text == "FALSE") {
      value = false;
      return true;
    }
  }
  context.errors.add(node.mark, name + " must be true or false, not " + describe(node));
  return false;
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name,
                std::string& value) {
  if (node.kind != Kind::scalar || node.text.empty()) {
    context.errors.add(node.mark, name + " must be text, not " +
                                      (node.kind == Kind::scalar ? "empty" : describe(node)));
    return false;
  }
  value = node.text;
  return true;
}

bool read_numbers(ReadContext& context, const YamlNode& node, const ValueName& name, double* values,
                  std::size_t count, const NumberRange& range) {
  if (node.kind != Kind::list || node.items.size() != count) {
    context.errors.add(node.mark, name + " must be a list of " + std::to_string(count) +
                                      " numbers, not " + describe(node));
    return false;
  }
  std::vector<double> numbers(count);
  bool valid = true;
  for (std::size_t i = 0; i < count; ++i)
    valid = read_number(context, *node.items[i], name, numbers[i], range) && valid;
  if (valid) std::copy(numbers.begin(), numbers.end(), values);
  return valid;
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, DVec2& value,
                const NumberRange& range) {
  return read_numbers(context, node, name, &value.x, 2, range);
}

bool read_value(ReadContext& context, const YamlNode& node, const ValueName& name, DVec3& value,
                const NumberRange& range) {
  return read_numbers(context, node, name, &value.x, 3, range);
}

std::size_t read_option(ReadContext& context, const YamlNode& node, const ValueName& name,
                        const std::vector<std::string>& options) {
  if (node.kind != Kind::scalar) {
    context.errors.add(node.mark, name + " must be a word, not " + describe(node) +
                                      suggestion_and_options("", options));
    return options.size();
  }
  const auto found = std::find(options.begin(), options.end(), node.text);
  if (found == options.end()) {
    std::string word = describe(node);
    if (word.front() != '\'') word = "'" + word + "'";
    // "'type' of material 'white'" reads as "unknown type 'difuse' of material 'white'".
    const std::size_t end = name.find('\'', 1);
    context.errors.add(node.mark, "unknown " + name.substr(1, end - 1) + " " + word +
                                      name.substr(end + 1) +
                                      suggestion_and_options(node.text, options));
  }
  return static_cast<std::size_t>(found - options.begin());
}

bool is_map(ReadContext& context, const YamlNode* node, const std::string& title) {
  if (node == nullptr || node->kind == Kind::map) return true;
  context.errors.add(node->mark, title + " must be a map, not " + describe(*node) +
                                     (node->quoted ? "" : colon_hint(node->text)));
  return false;
}

bool is_list(ReadContext& context, const YamlNode& node, const std::string& title) {
  if (node.kind == Kind::list) return true;
  context.errors.add(node.mark, title + " must be a list, not " + describe(node));
  return false;
}

Mark MapReader::mark_of(std::string_view key) const {
  const YamlEntry* entry = node_ == nullptr ? nullptr : node_->find(key);
  return entry == nullptr ? mark() : entry->value->mark;
}

const YamlNode* MapReader::find(std::string_view key, bool is_required,
                                const std::vector<std::string>& options) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  if (recording()) {
    (*context_.language)[kind_][std::string(key)] = {is_required, options};
    return nullptr;
  }
  const YamlEntry* entry = node_ == nullptr ? nullptr : node_->find(key);
  if (entry != nullptr) return entry->value.get();
  if (is_required)
    context_.errors.add(mark(), "missing key '" + std::string(key) + "' in " + title_ +
                                    missing_hint(node_, key, options));
  return nullptr;
}

void MapReader::finish() const {
  if (node_ == nullptr || !keys_known_) return;
  for (const YamlEntry& entry : node_->entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    std::string hint = context_.hint == nullptr ? "" : context_.hint(entry.key, known_);
    if (hint.empty()) hint = colon_hint(entry.key);
    if (hint.empty()) hint = suggestion_or_keys(entry.key, known_);
    context_.errors.add(entry.mark, "unknown key '" + entry.key + "' in " + title_ + hint);
  }
}

}  // namespace pah
