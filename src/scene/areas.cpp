#include <algorithm>
#include <array>
#include <cmath>
#include <pah/geometry/basis.hpp>
#include <pah/scene/areas.hpp>
#include <stdexcept>
#include <unordered_map>

#include "geometry/rounding.hpp"

namespace pah {
namespace {

constexpr const char* camera_name = "camera";

// Rounds a position to float, as is done before rays start at it or aim at it.
DVec3 as_rays_see_it(const DVec3& position) {
  DVec3 seen;
  for (int k = 0; k < 3; ++k) {
    // Without volatile, GCC 12 vectorizes the two conversions and then drops both.
    const volatile float rounded = static_cast<float>(position[k]);
    seen[k] = double{rounded};
  }
  return seen;
}

// The widened box of all triangles. Rays of a bundle start in it and hit only what it holds.
struct Reachable {
  Aabb box;
  double margin = 0;

  explicit Reachable(const Aabb& bounds) : box(bounds) {
    if (bounds.empty()) return;
    const Vec3 largest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    // A ray starts within 15 roundings of a surface (spawn.hpp), and a hit lies within 30 of its
    // triangle (ray_triangle.hpp). Rounded numbers reach twice the largest coordinate.
    const float widening =
        rounding_bound(2 * (15 + 30)) * std::max(largest.x, std::max(largest.y, largest.z));
    box.min -= widening;
    box.max += widening;
    margin = widening;
  }

  // Returns the range of distances from `origin` that the box covers along a unit direction.
  [[nodiscard]] DVec2 range(const DVec3& origin, const DVec3& direction) const {
    const DVec3 half = 0.5 * (DVec3(box.max) - DVec3(box.min));
    const double center = glm::dot(DVec3(box.min) + half - origin, direction);
    const double radius = glm::dot(half, glm::abs(direction)) + margin;
    return {center - radius, center + radius};
  }
};

class Derivation {
 public:
  Derivation(const World& world, const FilmSettings& film, std::vector<SceneArea>& areas)
      : world_(world), film_(film), reachable_(world.bounds), areas_(areas) {}

  void derive_all() {
    if (world_.bounds.empty()) return;
    for (std::size_t i = 0; i < world_.lights.size(); ++i) {
      light_ = world_.lights[i].name;
      bundle_ = static_cast<std::uint32_t>(i);
      std::visit([this](const auto& model) { derive(model); }, world_.lights[i].model);
    }
    light_ = camera_name;
    bundle_ = camera_bundle;
    std::visit([this](const auto& camera) { derive(camera); }, world_.camera);
  }

 private:
  void derive(const PointLight& light) { add_sides(light.position); }

  void derive(const SpotLight& light) {
    // Near 90 degrees, a single frustum fills almost the whole half-space; beyond, none exists.
    constexpr double widest = 80;
    if (light.angle >= widest) return add_sides(light.position);
    add_frustum("", as_rays_see_it(light.position), orthonormal_basis(light.direction),
                DVec2(std::tan(glm::radians(light.angle))), PointMeasure::solid_angle);
  }

  void derive(const DirectionalLight& light) {
    if (light.angle > 0) return;
    const DMat3 axes = orthonormal_basis(light.direction);
    DVec3 center(0);
    DVec3 half_size;
    for (int k = 0; k < 3; ++k) {
      const DVec2 range = reachable_.range(DVec3(0), axes[k]);
      center += 0.5 * (range.x + range.y) * axes[k];
      half_size[k] = 0.5 * (range.y - range.x);
    }
    add("", PlaneArea{{center, axes, half_size}});
  }

  void derive(const AreaLight& /*light*/) {}
  void derive(const EnvironmentLight& /*light*/) {}

  void derive(const PerspectiveCamera& camera) {
    if (camera.aperture_radius > 0) return;
    const DVec2 half = half_picture(std::tan(glm::radians(camera.fov) / 2));
    // Directions are sums of three vectors with at most 6 roundings each.
    const DVec2 widening = rounding_bound(18) * (1 + half.x + half.y) * (1.0 + half);
    add_frustum("", as_rays_see_it(camera.position), frame_of(camera), half + widening,
                PointMeasure::plane);
  }

  void derive(const OrthographicCamera& camera) {
    const DMat3 axes = frame_of(camera);
    const DVec3 position = as_rays_see_it(camera.position);
    const double depth = reachable_.range(position, axes[2]).y;
    if (!(depth > 0)) return;
    const DVec2 half = half_picture(camera.height / 2);
    // Origins are sums of three vectors, as above.
    const double largest = glm::length(position) + half.x + half.y;
    const double widening = rounding_bound(18) * largest;
    add("",
        PlaneArea{{position + 0.5 * depth * axes[2], axes, DVec3(half, 0.5 * depth) + widening}});
  }

  // Right, up and forward, right-handed: the picture's x runs to the left.
  template <typename AnyCamera>
  static DMat3 frame_of(const AnyCamera& camera) {
    const DVec3 forward = glm::normalize(camera.look_at - camera.position);
    const DVec3 left = glm::normalize(glm::cross(camera.up, forward));
    return {left, glm::cross(forward, left), forward};
  }

  // Half the picture's size, with the margin that the filter reaches beyond it.
  [[nodiscard]] DVec2 half_picture(double half_height) const {
    const double beyond = 2 * std::max(0.0, film_.filter_radius - 0.5);
    return half_height / film_.height * DVec2(film_.width + beyond, film_.height + beyond);
  }

  void add_sides(const DVec3& position) {
    constexpr std::array<const char*, 6> sides{"-x", "+x", "-y", "+y", "-z", "+z"};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      DVec3 forward(0);
      forward[static_cast<int>(i / 2)] = i % 2 == 0 ? -1 : 1;
      add_frustum(sides[i], as_rays_see_it(position), orthonormal_basis(forward), DVec2(1),
                  PointMeasure::solid_angle);
    }
  }

  // Adds a frustum that reaches to the end of the scene, unless it misses the scene.
  void add_frustum(const char* side, const DVec3& eye, const DMat3& axes, const DVec2& tan_half,
                   PointMeasure measure) {
    const double far = reachable_.range(eye, axes[2]).y;
    if (!(far > 0)) return;
    const Frustum frustum{eye, axes, tan_half, 0, far};
    if (overlaps(Region(frustum), reachable_.box)) add(side, PointArea{frustum, measure});
  }

  void add(const std::string& side, const InfluenceArea& area) {
    areas_.push_back({side.empty() ? light_ : light_ + " " + side, light_, bundle_, area, false});
  }

  const World& world_;
  const FilmSettings& film_;
  Reachable reachable_;
  std::vector<SceneArea>& areas_;
  std::string light_;
  std::uint32_t bundle_ = no_bundle;
};

// Returns the bundle of the light that a declaration names.
std::uint32_t bundle_of(const World& world, const std::string& light) {
  if (light == camera_name) return camera_bundle;
  const auto found = std::ranges::find(world.lights, light, &Light::name);
  if (found == world.lights.end())
    throw std::invalid_argument("an influence area names '" + light +
                                "', which is not a light of the scene");
  return static_cast<std::uint32_t>(found - world.lights.begin());
}

BundleShape shape_of(const World& world, std::uint32_t bundle) {
  return bundle == camera_bundle ? bundle_shape(world.camera) : bundle_shape(world.lights[bundle]);
}

// Returns the point where the rays of a bundle meet.
DVec3 meeting_point(const World& world, std::uint32_t bundle) {
  if (bundle == camera_bundle) return std::get<PerspectiveCamera>(world.camera).position;
  const auto& model = world.lights[bundle].model;
  if (const auto* point = std::get_if<PointLight>(&model)) return point->position;
  return std::get<SpotLight>(model).position;
}

InfluenceArea area_of(const World& world, std::uint32_t bundle,
                      const PlaneAreaDeclaration& declared) {
  if (shape_of(world, bundle) != BundleShape::parallel)
    throw std::invalid_argument("a plane area is declared for '" + declared.light +
                                "', whose rays are not parallel");
  return make_plane_area(declared.position - world.origin, declared.direction, declared.size,
                         declared.depth);
}

InfluenceArea area_of(const World& world, std::uint32_t bundle,
                      const PointAreaDeclaration& declared) {
  if (shape_of(world, bundle) != BundleShape::point)
    throw std::invalid_argument("a point area is declared for '" + declared.light +
                                "', whose rays do not meet in a point");
  return make_point_area(as_rays_see_it(meeting_point(world, bundle)), declared.forward,
                         glm::radians(declared.fov), declared.near, declared.far,
                         bundle == camera_bundle ? PointMeasure::plane : PointMeasure::solid_angle);
}

SceneArea declared_area(const World& world, const AreaDeclaration& declaration) {
  return std::visit(
      [&](const auto& declared) {
        const std::uint32_t bundle = bundle_of(world, declared.light);
        return SceneArea{declared.light, declared.light, bundle, area_of(world, bundle, declared),
                         true};
      },
      declaration);
}

// Numbers equal names: "lamp", "lamp 2", "lamp 3".
void number_names(std::vector<SceneArea>& areas) {
  std::unordered_map<std::string, int> seen;
  for (SceneArea& area : areas) {
    const int count = ++seen[area.name];
    if (count > 1) area.name += " " + std::to_string(count);
  }
}

}  // namespace

BundleShape bundle_shape(const Light& light) {
  if (std::holds_alternative<PointLight>(light.model) ||
      std::holds_alternative<SpotLight>(light.model))
    return BundleShape::point;
  return std::holds_alternative<DirectionalLight>(light.model) ? BundleShape::parallel
                                                               : BundleShape::neither;
}

BundleShape bundle_shape(const Camera& camera) {
  const auto* perspective = std::get_if<PerspectiveCamera>(&camera);
  if (perspective == nullptr) return BundleShape::parallel;
  return perspective->aperture_radius == 0 ? BundleShape::point : BundleShape::neither;
}

std::string_view type_name(const InfluenceArea& area) {
  return std::holds_alternative<PlaneArea>(area) ? "plane" : "point";
}

std::vector<SceneArea> areas_of(const World& world, const InfluenceSettings& settings,
                                const FilmSettings& film) {
  std::vector<SceneArea> areas;
  areas.reserve(settings.declared.size());
  for (const AreaDeclaration& declaration : settings.declared)
    areas.push_back(declared_area(world, declaration));
  if (settings.derive) Derivation(world, film, areas).derive_all();
  number_names(areas);
  return areas;
}

}  // namespace pah
