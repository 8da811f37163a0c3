// Transforms: steps of translation, rotation, scale and look_at.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <pah/scene/placement.hpp>

#include "geometry/rounding.hpp"
#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

// Returns whether the determinant differs from 0 by more than its rounding error. Each of its six
// triple products goes through at most five roundings.
bool invertible(const DMat4& m) {
  double determinant = 0, magnitude = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double plus = m[0][i] * m[1][j] * m[2][k], minus = m[0][i] * m[1][k] * m[2][j];
    determinant += plus - minus;
    magnitude += std::abs(plus) + std::abs(minus);
  }
  return std::isfinite(magnitude) && std::abs(determinant) > 8 * double_unit_roundoff * magnitude;
}

bool read_axis(MapReader& map, DVec3& axis) {
  const YamlNode* node = map.find("axis", true);
  if (node == nullptr) return false;
  const ValueName name = map.name_of("axis");
  if (node->kind == Kind::list) {
    DVec3 given{};
    if (!read_value(map.context(), *node, name, given)) return false;
    const double scale = std::max({std::abs(given.x), std::abs(given.y), std::abs(given.z)});
    if (scale == 0) {
      map.error("axis", name + " must not be zero");
      return false;
    }
    axis = glm::normalize(given / scale);
    return true;
  }
  const std::size_t index = read_option(map.context(), *node, name, {"x", "y", "z"});
  if (index < 3) axis = DVec3(index == 0, index == 1, index == 2);
  return index < 3;
}

// Is exact for quarter turns, so that a floor turned into a wall stays flat.
DMat3 rotation_about(const DVec3& axis, double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarters = turn / 90;
  double sine = std::sin(glm::radians(turn)), cosine = std::cos(glm::radians(turn));
  if (quarters == std::round(quarters)) {
    const int quarter = (static_cast<int>(quarters) + 4) % 4;
    sine = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
    cosine = quarter == 0 ? 1 : quarter == 2 ? -1 : 0;
  }
  // Rodrigues' formula.
  const DMat3 cross{0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0};
  return cosine * DMat3(1.0) + sine * cross + (1 - cosine) * glm::outerProduct(axis, axis);
}

DMat4 read_scale(ReadContext& context, const YamlNode& node, const ValueName& name) {
  DVec3 factors{1};
  if (node.kind == Kind::list) {
    read_value(context, node, name, factors);
  } else {
    double factor = 1;
    read_value(context, node, name, factor);
    factors = DVec3(factor);
  }
  return glm::scale(DMat4(1.0), factors);
}

// Turns the object as a camera: its -z axis points from `from` to `to`, its y axis up.
DMat4 read_look_at(ReadContext& context, const YamlNode* node, const std::string& title) {
  DMat4 result(1.0);
  read_map(context, node, "look_at", "look_at of " + title, [&](MapReader& map) {
    DVec3 from{0}, to{0, 0, -1}, up{0, 1, 0};
    map.optional("from", from);
    const bool given = map.required("to", to);
    map.optional("up", up);
    if (!given) return;
    const DVec3 forward = to - from;
    const DVec3 side = glm::cross(forward, up);
    if (glm::length(side) <=
        8 * std::numeric_limits<double>::epsilon() * glm::length(forward) * glm::length(up)) {
      map.error("to", map.title() + " has no direction: 'to' is at 'from', or 'up' is parallel");
      return;
    }
    const DVec3 back = -glm::normalize(forward), right = glm::normalize(side);
    result = DMat4(DMat3(right, glm::cross(back, right), back));
    result[3] = glm::dvec4(from, 1);
  });
  return result;
}

DMat4 read_matrix(ReadContext& context, const YamlNode& node, const ValueName& name) {
  std::array<double, 16> rows{};
  if (!read_numbers(context, node, name, rows.data(), rows.size())) return DMat4(1.0);
  if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] != 1) {
    context.errors.add(node.mark, name + " must end with the row 0, 0, 0, 1");
    return DMat4(1.0);
  }
  DMat4 matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix[column][row] = rows[static_cast<std::size_t>(4 * row + column)];
  return matrix;
}

// Reads a step, a map with one key.
DMat4 read_step(ReadContext& context, const YamlNode* node, const std::string& title) {
  DMat4 result(1.0);
  const std::string step_title = "transform of " + title;
  if (node != nullptr && node->kind == Kind::map && node->entries.size() != 1) {
    context.errors.add(node->mark, "a step of the " + step_title + " must have one key, not " +
                                       std::to_string(node->entries.size()) +
                                       ": several steps are a list");
    return result;
  }
  read_map(context, node, "transform", step_title, [&](MapReader& map) {
    DVec3 offset{0};
    if (map.optional("translate", offset)) result = glm::translate(DMat4(1.0), offset);
    map.nested("rotate", [&](const YamlNode* value) {
      result = DMat4(read_rotation(context, value, "rotate of " + title));
    });
    if (const YamlNode* value = map.find("scale"))
      result = read_scale(context, *value, "'scale' of " + title);
    map.nested("look_at",
               [&](const YamlNode* value) { result = read_look_at(context, value, title); });
    if (const YamlNode* value = map.find("matrix"))
      result = read_matrix(context, *value, "'matrix' of " + title);
  });
  if (node != nullptr && !invertible(result)) {
    context.errors.add(node->mark, step_title + " is singular: it leaves no volume");
    return DMat4(1.0);
  }
  return result;
}

}  // namespace

DMat3 read_rotation(ReadContext& context, const YamlNode* node, const ValueName& name) {
  DVec3 axis{0, 1, 0};
  double angle = 0;
  if (node != nullptr && node->kind == Kind::scalar) {
    read_value(context, *node, name, angle);
    return rotation_about(axis, angle);
  }
  read_map(context, node, "rotate", name, [&](MapReader& map) {
    read_axis(map, axis);
    map.required("angle", angle);
  });
  return rotation_about(axis, angle);
}

DMat4 read_transform(ReadContext& context, const YamlNode* node, const std::string& title) {
  if (node == nullptr || node->kind == Kind::map) {
    if (node == nullptr && context.language == nullptr) return DMat4(1.0);
    return read_step(context, node, title);
  }
  DMat4 result(1.0);
  if (!is_list(context, *node, "transform of " + title)) return result;
  for (const YamlRef& step : node->items) result = read_step(context, step.get(), title) * result;
  if (!invertible(result)) {
    context.errors.add(node->mark, "transform of " + title + " is singular: it leaves no volume");
    return DMat4(1.0);
  }
  return result;
}

}  // namespace pah
