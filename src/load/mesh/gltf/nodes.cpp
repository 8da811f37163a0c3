#include "load/mesh/gltf/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <pah/scene/placement.hpp>
#include <string>

#include "load/mesh/gltf/json.hpp"

namespace pah {
namespace {

constexpr double lumens_per_watt = 683;

double degrees(double radians) { return radians * (180 / std::numbers::pi); }

glm::dmat4x3 parent_from_node(const Json& node) {
  if (const auto found = node.find("matrix"); found != node.end()) {
    glm::dmat4x3 m;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row)
        m[column][row] = found->at(static_cast<std::size_t>(4 * column + row)).get<double>();
    return m;
  }
  const DVec3 scale = vec(node, "scale", DVec3(1));
  glm::dquat rotation{1, 0, 0, 0};
  if (const auto r = node.find("rotation"); r != node.end())
    rotation = glm::dquat{r->at(3).get<double>(), r->at(0).get<double>(), r->at(1).get<double>(),
                          r->at(2).get<double>()};
  const DMat3 turn = glm::mat3_cast(glm::normalize(rotation));
  return {turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z,
          vec(node, "translation", DVec3(0))};
}

// Cameras and lights point along -z.
DVec3 forward_of(const glm::dmat4x3& world_from_node) { return -world_from_node[2]; }

class NodeReader {
 public:
  NodeReader(const Json& document, std::vector<GltfPlace>& places, MeshFile& out)
      : nodes_(list(document, "nodes")),
        cameras_(list(document, "cameras")),
        lights_(list(child(child(document, "extensions"), punctual), "lights")),
        meshes_(list(document, "meshes").size()),
        places_(places),
        out_(out) {}

  // Earlier checks ensure that nodes form trees of limited depth.
  void read(std::size_t index, const glm::dmat4x3& world_from_parent) {
    const Json& node = nodes_.at(index);
    const glm::dmat4x3 world = compose(world_from_parent, parent_from_node(node));
    // An entry that is not finite makes the determinant or the translation so.
    const DVec3 place = world[3];
    if (!std::isfinite(glm::determinant(DMat3(world))) ||
        !std::isfinite(place.x + place.y + place.z) || glm::length(place) > largest_coordinate)
      throw MeshFileError("the transform of a node is not finite");
    if (node.contains("mesh")) places_.push_back({index_of(node, "mesh", meshes_), world});
    if (node.contains("camera"))
      read_camera(node, cameras_.at(index_of(node, "camera", cameras_.size())), world);
    const Json& light = child(child(node, "extensions"), punctual);
    if (light.contains("light"))
      read_light(node, lights_.at(index_of(light, "light", lights_.size())), world);
    for (const Json& below : list(node, "children")) read(below.get<std::size_t>(), world);
  }

 private:
  static std::string name_of(const Json& node, const Json& item, const char* fallback) {
    return node.value("name", item.value("name", std::string(fallback)));
  }

  void read_camera(const Json& node, const Json& source, const glm::dmat4x3& world) {
    const auto add = [&](auto camera) {
      camera.position = world[3];
      camera.look_at = world[3] + glm::normalize(forward_of(world));
      camera.up = world[1];
      out_.cameras.push_back({name_of(node, source, "camera"), camera});
    };
    if (source.at("type") == "orthographic") {
      OrthographicCamera camera;
      camera.height = 2 * source.at("orthographic").at("ymag").get<double>();
      if (camera.height > 0) add(camera);
    } else {
      PerspectiveCamera camera;
      camera.fov = degrees(source.at("perspective").at("yfov").get<double>());
      if (camera.fov > 0 && camera.fov < 180) add(camera);
    }
  }

  void read_light(const Json& node, const Json& source, const glm::dmat4x3& world) {
    const DVec3 color = vec(source, "color", DVec3(1));
    const Vec3 power = Vec3(color * (source.value("intensity", 1.0) / lumens_per_watt));
    for (int k = 0; k < 3; ++k)
      if (!(power[k] >= 0 && std::isfinite(power[k])))
        throw MeshFileError("a light's intensity is negative or too large");
    Light light;
    light.name = name_of(node, source, "light");
    const std::string type = source.at("type").get<std::string>();
    if (type == "directional") {
      light.model = DirectionalLight{forward_of(world), power, 0};
    } else if (type == "spot") {
      const Json cone = source.value("spot", Json::object());
      const double outer = degrees(cone.value("outerConeAngle", std::numbers::pi / 4));
      const double inner = degrees(cone.value("innerConeAngle", 0.0));
      if (!(outer > 0 && outer <= 90.001))
        throw MeshFileError("a spot's cone is not between 0 and 90 degrees");
      SpotLight spot;
      spot.position = world[3];
      spot.direction = forward_of(world);
      spot.intensity = power;
      spot.angle = std::min(outer, 90.0);
      spot.blend = std::clamp(1 - inner / outer, 0.0, 1.0);
      light.model = spot;
    } else {
      light.model = PointLight{world[3], power};
    }
    out_.lights.push_back(std::move(light));
  }

  static constexpr const char* punctual = "KHR_lights_punctual";
  static constexpr double largest_coordinate = 1e30;  // its square is finite

  const Json& nodes_;
  const Json& cameras_;
  const Json& lights_;
  std::size_t meshes_;
  std::vector<GltfPlace>& places_;
  MeshFile& out_;
};

// Checks that every node has at most one parent and is not too deep, so that recursion ends.
// Returns the roots.
std::vector<std::size_t> check_nodes(const Json& nodes) {
  constexpr int max_depth = 256;
  std::vector<std::size_t> parent(nodes.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Json& below : list(nodes[i], "children")) {
      if (!below.is_number_unsigned() || below.get<std::uint64_t>() >= nodes.size())
        throw MeshFileError("node " + std::to_string(i) + " has a child that does not exist");
      std::size_t& above = parent[below.get<std::size_t>()];
      if (above != nodes.size())
        throw MeshFileError("node " + below.dump() + " has more than one parent");
      above = i;
    }
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (parent[i] == nodes.size()) roots.push_back(i);
    int depth = 0;
    for (std::size_t at = i; at != nodes.size(); at = parent[at])
      if (++depth > max_depth)
        throw MeshFileError("the nodes form a cycle, or are nested more than " +
                            std::to_string(max_depth) + " deep");
  }
  return roots;
}

}  // namespace

std::vector<GltfPlace> read_gltf_nodes(const Json& document, MeshFile& out) {
  const Json& nodes = list(document, "nodes");
  std::vector<std::size_t> roots = check_nodes(nodes);
  // Without a default scene the first one is shown; without scenes, all nodes are.
  const Json& scenes = list(document, "scenes");
  if (!scenes.empty()) {
    const bool chosen = document.contains("scene");
    const Json& scene = scenes[chosen ? index_of(document, "scene", scenes.size()) : 0];
    roots.clear();
    for (const Json& root : list(scene, "nodes")) {
      if (!root.is_number_unsigned() || root.get<std::uint64_t>() >= nodes.size())
        throw MeshFileError("the scene names a node that does not exist");
      roots.push_back(root.get<std::size_t>());
    }
  }
  std::vector<GltfPlace> places;
  NodeReader reader(document, places, out);
  for (const std::size_t root : roots) reader.read(root, glm::dmat4x3{1.0});
  return places;
}

}  // namespace pah
