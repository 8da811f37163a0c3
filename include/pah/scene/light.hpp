// Lights, as values in scene coordinates. LightId is an index in Scene::lights.
#pragma once

#include <optional>
#include <pah/geometry/exact_bundle.hpp>
#include <pah/scene/mesh.hpp>
#include <variant>

namespace pah {

struct PointLight {
  DVec3 position{0};
  Vec3 intensity{1};  // W/sr
};

struct SpotLight {
  DVec3 position{0};
  DVec3 direction{0, -1, 0};  // any length but 0
  Vec3 intensity{1};          // W/sr on the axis
  double angle = 30;          // half-angle of the cone, degrees, in (0, 90]
  double blend = 0.15;        // share of the angle over which it falls off smoothly, in [0, 1]
};

struct DirectionalLight {
  DVec3 direction{0, -1, 0};  // in which the light travels; any length but 0
  Vec3 irradiance{1};         // W/m2 on a surface facing it
  double angle = 0;           // angular diameter, degrees, in [0, 90]; the sun's is 0.53
};

// Emits from the instances whose `light` is this one.
struct AreaLight {
  Vec3 radiance{1};  // W/(m2 sr); multiplies the image, if there is one
  bool two_sided = false;
  TextureId image = no_texture;  // an ImageTexture, by the surfaces' texture coordinates
};

// Radiance from everywhere around the scene.
struct EnvironmentLight {
  Vec3 radiance{1};              // W/(m2 sr); multiplies the image, if there is one
  TextureId image = no_texture;  // lat-long; its center is direction -z, its top +y
  DMat3 world_from_light{1.0};   // a rotation
};

struct Light {
  std::string name;
  std::variant<PointLight, SpotLight, DirectionalLight, AreaLight, EnvironmentLight> model;
};

// The shadow rays that the renderer sends to a light, if they share a point or a direction.
[[nodiscard]] std::optional<ExactBundle> exact_bundle(const Light& light);

}  // namespace pah
