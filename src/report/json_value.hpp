// A JSON value to be written. nlohmann/json takes seconds to compile wherever it is used: here it
// is compiled once.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pah {

class JsonValue {
 public:
  using Members = std::initializer_list<std::pair<std::string_view, JsonValue>>;

  // NOLINTBEGIN(google-explicit-constructor): values are to be written as they are.
  JsonValue();  // null
  JsonValue(double value);
  JsonValue(std::string_view value);
  JsonValue(const std::string& value) : JsonValue(std::string_view(value)) {}
  JsonValue(const char* value) : JsonValue(std::string_view(value)) {}
  template <std::integral Integer>
  JsonValue(Integer value) : JsonValue(from(widened(value))) {}
  template <typename Value>
  JsonValue(const std::optional<Value>& value)
      : JsonValue(value ? JsonValue(*value) : JsonValue()) {}
  JsonValue(const std::vector<JsonValue>& elements);
  JsonValue(Members members);  // keeps their order
  // NOLINTEND(google-explicit-constructor)

  JsonValue(const JsonValue& other);
  JsonValue(JsonValue&&) noexcept;
  JsonValue& operator=(JsonValue other) noexcept;
  ~JsonValue();

  static JsonValue array(std::initializer_list<JsonValue> elements = {});
  static JsonValue object(Members members = {}) { return {members}; }

  // Of an object; a member of that name is replaced.
  void set(std::string_view name, JsonValue value);
  // Of an array.
  void push_back(JsonValue value);

  // On one line, or indented. Bytes that are not UTF-8 are replaced.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string indented_text() const;

 private:
  template <std::integral Integer>
  static auto widened(Integer value) {
    if constexpr (std::same_as<Integer, bool>)
      return value;
    else if constexpr (std::signed_integral<Integer>)
      return std::int64_t{value};
    else
      return std::uint64_t{value};
  }
  static JsonValue from(bool value);
  static JsonValue from(std::int64_t value);
  static JsonValue from(std::uint64_t value);

  std::unique_ptr<nlohmann::ordered_json> json_;
};

}  // namespace pah
