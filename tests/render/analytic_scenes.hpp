// Small scenes with known radiance, and statistics for comparing renders with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <pah/render/render.hpp>
#include <pah/scene/shapes.hpp>

namespace pah::test {

inline constexpr double pi = std::numbers::pi;

// Builds a scene. `scale` and `offset` are applied to everything that is added.
class SceneBuilder {
 public:
  explicit SceneBuilder(double scale = 1, DVec3 offset = DVec3(0))
      : scale_(scale), offset_(offset) {
    scene.materials.push_back({"black", DiffuseMaterial{{Vec3(0), no_texture}}});
    // The film keeps all layers, so that tests can compare them.
    scene.film.albedo = scene.film.normal = scene.film.depth = true;
  }

  MaterialId material(MaterialModel model) {
    scene.materials.push_back({"", std::move(model)});
    return static_cast<MaterialId>(scene.materials.size() - 1);
  }
  MaterialId diffuse(float reflectance) {
    return material(DiffuseMaterial{{Vec3(reflectance), no_texture}});
  }

  void add(const Shape& shape, MaterialId material, const glm::dmat4& placement = glm::dmat4(1),
           LightId light = no_light) {
    scene.meshes.push_back(make_mesh(shape));
    Instance instance;
    instance.mesh = static_cast<MeshId>(scene.meshes.size() - 1);
    instance.material = material;
    instance.light = light;
    const glm::dmat4 unit =
        glm::translate(glm::dmat4(1), offset_) * glm::scale(glm::dmat4(1), DVec3(scale_));
    instance.world_from_object = glm::dmat4x3(unit * placement);
    scene.instances.push_back(instance);
  }

  template <class Model>
  LightId light(Model model) {
    if constexpr (requires { model.position; }) model.position = place(model.position);
    if constexpr (requires { model.intensity; }) {
      model.intensity *= static_cast<float>(scale_ * scale_);
    }
    scene.lights.push_back({"", std::move(model)});
    return static_cast<LightId>(scene.lights.size() - 1);
  }

  void look(DVec3 position, DVec3 look_at, double fov, DVec3 up = DVec3(0, 1, 0)) {
    PerspectiveCamera camera;
    camera.position = place(position);
    camera.look_at = place(look_at);
    camera.up = up;
    camera.fov = fov;
    scene.camera = camera;
  }

  // Makes the camera see a square of the given side. Over a tiny square nothing varies.
  void look_parallel(DVec3 position, DVec3 look_at, double height, DVec3 up = DVec3(0, 0, -1)) {
    OrthographicCamera camera;
    camera.position = place(position);
    camera.look_at = place(look_at);
    camera.up = up;
    camera.height = height * scale_;
    scene.camera = camera;
  }

  void film(int size, int samples) {
    scene.film.width = scene.film.height = size;
    scene.film.filter = PixelFilter::box;
    scene.film.filter_radius = 0.5;
    scene.render.samples = samples;
  }

  Scene scene;

 private:
  [[nodiscard]] DVec3 place(const DVec3& point) const { return offset_ + scale_ * point; }

  double scale_;
  DVec3 offset_;
};

inline glm::dmat4 moved(DVec3 by) { return glm::translate(glm::dmat4(1), by); }
inline glm::dmat4 turned(double degrees, DVec3 axis) {
  return glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
}

enum class Answer { global_bvh, brute_force };

inline RenderResult render_scene(const Scene& scene, const RenderOptions& options = {},
                                 Answer answer = Answer::global_bvh) {
  const World world = make_world(scene);
  const auto accelerator = answer == Answer::global_bvh ? make_global_bvh(world.triangles())
                                                        : make_brute_force(world.triangles());
  return render(world, *accelerator, scene.film, scene.render, options);
}

// The mean of all samples of the green channel, as if the film were one pixel.
struct Estimate {
  double mean = 0;
  double sigma = 0;  // standard deviation of the mean
  double samples = 0;
};

inline Estimate estimate(const Film& film) {
  double sum = 0, squares = 0, n = 0;
  for (const FilmPixel& pixel : film.pixels) {
    sum += pixel.radiance().y;
    squares += pixel.sum_of_squares.y;
    n += pixel.samples;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n), n};
}

inline Estimate estimate(const Scene& scene) { return estimate(render_scene(scene).film); }

// Returns the distance of an estimate from a known value, in units of its sigma. Allows for the
// rounding of float arithmetic in every sample.
inline double sigmas_off(const Estimate& e, double expected) {
  const double tolerance = e.sigma + 1e-6 * expected;
  return tolerance > 0 ? std::abs(e.mean - expected) / tolerance : e.mean > 0 ? 1e9 : 0;
}

// Returns the two-sided p-value of Welch's test for large samples, where t is normal.
inline double welch_p(const Estimate& a, const Estimate& b) {
  const double sigma = std::sqrt(a.sigma * a.sigma + b.sigma * b.sigma);
  return std::erfc(std::abs(a.mean - b.mean) / sigma / std::numbers::sqrt2);
}

// Compares everything except depths, which change with the scale of a scene.
inline bool identical(const Film& a, const Film& b) {
  if (a.pixels.size() != b.pixels.size() || a.features.size() != b.features.size()) return false;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const FilmPixel& p = a.pixels[i];
    const FilmPixel& q = b.pixels[i];
    if (p.sum != q.sum || p.error != q.error || p.sum_of_squares != q.sum_of_squares ||
        p.samples != q.samples || p.hits != q.hits) {
      return false;
    }
  }
  return std::ranges::equal(a.features, b.features, {}, &FilmFeatures::albedo,
                            &FilmFeatures::albedo) &&
         std::ranges::equal(a.features, b.features, {}, &FilmFeatures::normal,
                            &FilmFeatures::normal);
}

}  // namespace pah::test
