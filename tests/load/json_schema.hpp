// The part of JSON Schema (2020-12) that the scene language's schema uses.
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace pah {

class JsonSchema {
 public:
  explicit JsonSchema(nlohmann::json root) : root_(std::move(root)) {}
  [[nodiscard]] bool accepts(const nlohmann::json& value) const { return accepts(root_, value); }

 private:
  using Json = nlohmann::json;

  [[nodiscard]] bool accepts(const Json& schema, const Json& value) const {
    for (const auto& [keyword, rule] : schema.items())
      if (!holds(keyword, rule, schema, value)) return false;
    return true;
  }

  [[nodiscard]] bool holds(const std::string& keyword, const Json& rule, const Json& schema,
                           const Json& value) const {
    static const std::set<std::string> notes{"$schema", "$defs", "title", "description", "default"};
    if (notes.contains(keyword)) return true;
    if (keyword == "$ref")
      return accepts(root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), value);
    if (keyword == "anyOf" || keyword == "oneOf") {
      const auto count = std::count_if(rule.begin(), rule.end(),
                                       [&](const Json& one) { return accepts(one, value); });
      return keyword == "anyOf" ? count > 0 : count == 1;
    }
    if (keyword == "type") return is_type(rule, value);
    if (keyword == "const") return value == rule;
    if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
    if (keyword == "minLength") return !value.is_string() || value.size() >= rule;
    if (keyword == "pattern")
      return !value.is_string() ||
             std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    if (const auto holds_number = number_rule(keyword, rule, value)) return *holds_number;
    if (const auto holds_list = list_rule(keyword, rule, value)) return *holds_list;
    return object_rule(keyword, rule, schema, value);
  }

  static bool is_type(const Json& rule, const Json& value) {
    if (rule == "object") return value.is_object();
    if (rule == "array") return value.is_array();
    if (rule == "string") return value.is_string();
    if (rule == "boolean") return value.is_boolean();
    if (rule == "number") return value.is_number();
    if (rule == "integer")
      return value.is_number() &&
             (value.is_number_integer() || value.get<double>() == std::floor(value.get<double>()));
    throw std::logic_error("unknown type " + rule.dump());
  }

  static std::optional<bool> number_rule(const std::string& keyword, const Json& rule,
                                         const Json& value) {
    const bool number = value.is_number();
    if (keyword == "minimum") return !number || value >= rule;
    if (keyword == "maximum") return !number || value <= rule;
    if (keyword == "exclusiveMinimum") return !number || value > rule;
    if (keyword == "exclusiveMaximum") return !number || value < rule;
    return {};
  }

  [[nodiscard]] std::optional<bool> list_rule(const std::string& keyword, const Json& rule,
                                              const Json& value) const {
    const bool list = value.is_array();
    if (keyword == "minItems") return !list || value.size() >= rule;
    if (keyword == "maxItems") return !list || value.size() <= rule;
    if (keyword == "items")
      return !list || std::all_of(value.begin(), value.end(),
                                  [&](const Json& item) { return accepts(rule, item); });
    return {};
  }

  [[nodiscard]] bool object_rule(const std::string& keyword, const Json& rule, const Json& schema,
                                 const Json& value) const {
    const bool object = value.is_object();
    if (keyword == "minProperties") return !object || value.size() >= rule;
    if (keyword == "maxProperties") return !object || value.size() <= rule;
    if (keyword == "required")
      return !object || std::all_of(rule.begin(), rule.end(), [&](const Json& key) {
        return value.contains(key.get<std::string>());
      });
    if (keyword == "properties" || keyword == "patternProperties") {
      if (!object) return true;
      for (const auto& [key, item] : value.items())
        for (const auto& [name, one] : rule.items()) {
          const bool matches =
              keyword == "properties" ? name == key : std::regex_search(key, std::regex(name));
          if (matches && !accepts(one, item)) return false;
        }
      return true;
    }
    if (keyword != "additionalProperties") throw std::logic_error("unknown keyword " + keyword);
    if (!object) return true;
    const Json named_keys = schema.value("properties", Json::object());
    const Json patterns = schema.value("patternProperties", Json::object());
    for (const auto& [key, item] : value.items()) {
      bool named = named_keys.contains(key);
      for (const auto& [name, unused] : patterns.items())
        named = named || std::regex_search(key, std::regex(name));
      if (!named && (rule == false || !accepts(rule, item))) return false;
    }
    return true;
  }

  Json root_;
};

}  // namespace pah
