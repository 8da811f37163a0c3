// The integrator: unidirectional path tracing with next-event estimation, one batch at a time.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/render/counts.hpp>
#include <pah/render/film.hpp>
#include <pah/scene/world.hpp>

#include "image/texture/store.hpp"
#include "render/light/lights.hpp"
#include "render/path/camera_rays.hpp"
#include "render/path/path_batch.hpp"
#include "render/surface/surface_interaction.hpp"

namespace pah {

class PathTracer {
 public:
  // All references must outlive the tracer.
  PathTracer(const World& world, const Accelerator& accelerator, const TextureStore& textures,
             const FilmSettings& film, const RenderSettings& settings, bool count_traversal);

  // Makes arrays for `capacity` paths.
  [[nodiscard]] PathBatch make_batch(std::size_t capacity) const;

  // Adds the samples [first, first + count) of every pixel of a tile to the film. Thread-safe for
  // disjoint tiles; width * height * count is at most the batch's capacity.
  void trace(const PixelRect& tile, int first, int count, PathBatch& batch, Film& film) const;

 private:
  void generate(const PixelRect& tile, int first, int count, PathBatch& batch) const;
  void intersect(PathBatch& batch, RayKind kind) const;
  void shade(PathBatch& batch) const;
  void resolve_shadows(PathBatch& batch) const;
  void accumulate(const PixelRect& tile, int count, PathBatch& batch, Film& film) const;

  // Returns whether the path continues; `ray` is then its next ray.
  [[nodiscard]] bool shade_path(Path& path, Ray& ray, const Hit& hit, NumberReader& numbers,
                                PathBatch& batch) const;
  void add_distant(const Path& path, const Ray& ray, PathSample& sample) const;
  void add_emission(const Path& path, const Ray& ray, const Hit& hit, const SurfaceInteraction& at,
                    PathSample& sample) const;
  void gather_shadow(const Path& path, const struct Scattering& scattering, NumberReader& numbers,
                     PathBatch& batch) const;
  [[nodiscard]] bool scatter(Path& path, Ray& ray, const struct Scattering& scattering,
                             NumberReader& numbers) const;
  [[nodiscard]] float emission_weight(const Path& path, float light_pdf, LightId light) const;
  [[nodiscard]] float opacity_at(std::uint32_t triangle, const Vec2& barycentrics,
                                 float footprint) const;

  void sort_shadows(PathBatch& batch) const;
  void attenuate_shadows(PathBatch& batch) const;
  [[nodiscard]] std::uint32_t key_of(std::uint32_t bundle) const;
  [[nodiscard]] TraversalCounts* traversal(PathBatch& batch, RayKind kind) const;

  const World& world_;
  const Accelerator& accelerator_;
  const TextureStore& textures_;
  RenderSettings settings_;
  CameraRays camera_;
  Lights lights_;
  std::vector<std::uint8_t> masked_;  // per material: opacity is not simply 1
  bool any_masked_ = false;
  bool textured_;               // there are textures, which need the footprint of rays
  std::uint32_t keys_ = 1;      // of the sort by bundle
  std::size_t dimensions_ = 0;  // that a path may ask for at a surface
  bool count_traversal_;
};

}  // namespace pah
