#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <pah/scene/placement.hpp>
#include <string>

#include "io/mesh/gltf.hpp"

namespace pah {
namespace {

using Json = nlohmann::json;

constexpr double lumens_per_watt = 683;

const Json& list(const Json& object, const char* key) {
  static const Json none = Json::array();
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

double degrees(double radians) { return radians * (180 / std::numbers::pi); }

DVec3 vec(const Json& object, const char* key, const DVec3& otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  return {found->at(0).get<double>(), found->at(1).get<double>(), found->at(2).get<double>()};
}

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

// A camera and a light look along -z.
DVec3 forward_of(const glm::dmat4x3& world_from_node) { return -world_from_node[2]; }

class NodeReader {
 public:
  NodeReader(const Json& document, MeshFile& out)
      : nodes_(list(document, "nodes")), cameras_(list(document, "cameras")), out_(out) {
    const auto extensions = document.find("extensions");
    if (extensions == document.end()) return;
    const auto punctual = extensions->find("KHR_lights_punctual");
    if (punctual != extensions->end()) lights_ = &list(*punctual, "lights");
  }

  // The tree has been checked to be one, and not to be deep.
  void read(const Json& index, const glm::dmat4x3& world_from_parent) {
    const Json& node = nodes_.at(index.get<std::size_t>());
    const glm::dmat4x3 world = compose(world_from_parent, parent_from_node(node));
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row)
        if (!std::isfinite(world[column][row]))
          throw MeshFileError("the transform of a node is not finite");
    if (node.contains("camera"))
      read_camera(node, cameras_.at(node.at("camera").get<std::size_t>()), world);
    if (lights_ != nullptr && node.contains("extensions")) {
      const Json& extensions = node.at("extensions");
      const auto found = extensions.find("KHR_lights_punctual");
      if (found != extensions.end())
        read_light(node, lights_->at(found->at("light").get<std::size_t>()), world);
    }
    for (const Json& child : list(node, "children")) read(child, world);
  }

 private:
  static std::string name_of(const Json& node, const Json& thing, const char* otherwise) {
    return node.value("name", thing.value("name", std::string(otherwise)));
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

  const Json& nodes_;
  const Json& cameras_;
  const Json* lights_ = nullptr;
  MeshFile& out_;
};

}  // namespace

void read_gltf_cameras_and_lights(const GltfDocument& gltf, MeshFile& out) {
  if (gltf.nodes == nullptr) return;
  const Json& document = *gltf.nodes;
  try {
    NodeReader reader(document, out);
    const Json& scenes = list(document, "scenes");
    if (scenes.empty()) return;
    const Json& scene = scenes.at(document.value("scene", std::size_t{0}));
    for (const Json& root : list(scene, "nodes")) reader.read(root, glm::dmat4x3{1.0});
  } catch (const Json::exception&) {
    throw MeshFileError("a camera or light is not of the kind that glTF asks for");
  }
}

}  // namespace pah
