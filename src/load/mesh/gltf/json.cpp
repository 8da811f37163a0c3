#include "load/mesh/gltf/json.hpp"

#include <pah/load/mesh_file.hpp>

namespace pah {

const Json& list(const Json& object, const char* key) {
  static const Json none = Json::array();
  const auto found = object.find(key);
  if (found == object.end()) return none;
  if (!found->is_array()) throw MeshFileError("'" + std::string(key) + "' is not a list");
  return *found;
}

const Json& child(const Json& object, const char* key) {
  static const Json none = Json::object();
  const auto found = object.find(key);
  if (found == object.end()) return none;
  if (!found->is_object()) throw MeshFileError("'" + std::string(key) + "' is not an object");
  return *found;
}

std::uint64_t number(const Json& object, const char* key, std::uint64_t fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > (1ULL << 48))
    throw MeshFileError("'" + std::string(key) + "' is not a valid number");
  return found->get<std::uint64_t>();
}

std::size_t index_of(const Json& object, const char* key, std::size_t size) {
  const std::uint64_t value = number(object, key, UINT64_MAX);
  if (value >= size)
    throw MeshFileError("'" + std::string(key) + "' names number " +
                        (value == UINT64_MAX ? "none" : std::to_string(value)) + " of " +
                        std::to_string(size));
  return value;
}

DVec3 vec(const Json& object, const char* key, const DVec3& fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  return {found->at(0).get<double>(), found->at(1).get<double>(), found->at(2).get<double>()};
}

}  // namespace pah
