// Checked access to values of a glTF document. A value of the wrong type throws
// nlohmann::json::exception or MeshFileError.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <pah/geometry/vec.hpp>
#include <string>

namespace pah {

using Json = nlohmann::json;

// Returns the list under a key; empty if the key is absent.
[[nodiscard]] const Json& list(const Json& object, const char* key);
// Returns the object under a key; empty if the key is absent.
[[nodiscard]] const Json& child(const Json& object, const char* key);

// A count or an offset; `fallback` if the key is missing.
[[nodiscard]] std::uint64_t number(const Json& object, const char* key, std::uint64_t fallback);

// Returns an index in a list of `size`.
[[nodiscard]] std::size_t index_of(const Json& object, const char* key, std::size_t size);

[[nodiscard]] DVec3 vec(const Json& object, const char* key, const DVec3& fallback);

}  // namespace pah
