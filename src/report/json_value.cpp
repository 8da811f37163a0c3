#include "report/json_value.hpp"

#include <nlohmann/json.hpp>

namespace pah {

using Json = nlohmann::ordered_json;

namespace {

std::string dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

JsonValue::JsonValue() : json_(std::make_unique<Json>()) {}
JsonValue::JsonValue(double value) : json_(std::make_unique<Json>(value)) {}
JsonValue::JsonValue(std::string_view value) : json_(std::make_unique<Json>(value)) {}

JsonValue::JsonValue(const std::vector<JsonValue>& elements)
    : json_(std::make_unique<Json>(Json::array())) {
  for (const JsonValue& element : elements) json_->push_back(*element.json_);
}

JsonValue::JsonValue(Members members) : json_(std::make_unique<Json>(Json::object())) {
  for (const auto& [name, value] : members) (*json_)[std::string(name)] = *value.json_;
}

JsonValue::JsonValue(const JsonValue& other) : json_(std::make_unique<Json>(*other.json_)) {}
JsonValue::JsonValue(JsonValue&&) noexcept = default;
JsonValue& JsonValue::operator=(JsonValue other) noexcept {
  json_ = std::move(other.json_);
  return *this;
}
JsonValue::~JsonValue() = default;

JsonValue JsonValue::array(std::initializer_list<JsonValue> elements) {
  return std::vector<JsonValue>(elements);
}

JsonValue JsonValue::from(bool value) {
  JsonValue json;
  *json.json_ = value;
  return json;
}

JsonValue JsonValue::from(std::int64_t value) {
  JsonValue json;
  *json.json_ = value;
  return json;
}

JsonValue JsonValue::from(std::uint64_t value) {
  JsonValue json;
  *json.json_ = value;
  return json;
}

void JsonValue::set(std::string_view name, JsonValue value) {
  (*json_)[std::string(name)] = std::move(*value.json_);
}

void JsonValue::push_back(JsonValue value) { json_->push_back(std::move(*value.json_)); }

std::string JsonValue::text() const { return dump(*json_, -1); }
std::string JsonValue::indented_text() const { return dump(*json_, 2); }

}  // namespace pah
