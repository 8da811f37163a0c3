// JSON output: objects keep the order of their members.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace pah {

using OrderedJson = nlohmann::ordered_json;

template <typename Value>
[[nodiscard]] OrderedJson json_or_null(const std::optional<Value>& value) {
  return value ? OrderedJson(*value) : OrderedJson();
}

// Returns indented text; replaces bytes that are not UTF-8.
[[nodiscard]] inline std::string text_of(const OrderedJson& json) {
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace pah
