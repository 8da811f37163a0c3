#include "render/path/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/bsdf/material_eval.hpp"

namespace pah {

// A surface with its material at one point, seen from one direction. Built in place: copying a
// struct right after writing it stalls on store-to-load forwarding.
struct Scattering {
  Bsdf bsdf;
  ShadingFrame frame;
  Vec3 wo;            // in the frame
  Vec3 world_wo;      // towards where the path came from
  bool smooth;        // some lobe is no delta
  bool tilted;        // the shading normal is not the surface's own
  bool lifted;        // light is scattered off the facet, which may then be passed
  SurfacePoint from;  // where light is scattered
  Vec3 surface;       // the surface's own normal: that of the facet or of what it stands for
  LitPoint lit;

  // Returns whether both normals agree that the light is reflected, or that it passes through.
  [[nodiscard]] bool consistent(const Vec3& world_wi, const Vec3& wi) const {
    const bool reflects = wo.z * wi.z > 0;
    const auto agrees = [&](const Vec3& normal) {
      return reflects == (glm::dot(normal, world_wo) * glm::dot(normal, world_wi) > 0);
    };
    return agrees(surface) && (lifted || agrees(from.normal));
  }
  // The side of the facet on which light towards world_wi leaves.
  [[nodiscard]] const Vec3& side(const Vec3& world_wi, const Vec3& wi) const {
    return wo.z * wi.z > 0 ? world_wo : world_wi;
  }
};

namespace {

// Beyond this number, several lights share a group of shadow segments.
constexpr std::size_t most_keys = 4096;

// Veach's power heuristic with exponent 2; safe for infinite densities.
float power_heuristic(float own, float other) {
  if (!(own > 0)) return 0;
  const float ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

// Copied field by field: a copy of the whole struct would stall on the fields written just before.
void assign(Ray& to, const Ray& from) {
  to.origin = from.origin;
  to.t_max = from.t_max;
  to.direction = from.direction;
  to.bundle = from.bundle;
}

bool acceptable(const Vec3& color) {
  const float sum = color.x + color.y + color.z;
  return sum < std::numeric_limits<float>::infinity() && color.x >= 0 && color.y >= 0 &&
         color.z >= 0;
}

// The footprint of a ray's cone on a surface, in texture coordinates: the geometric mean of the
// ellipse's axes.
float footprint_on(const SurfaceInteraction& at, const Vec3& direction, float width) {
  const float cosine = std::abs(glm::dot(at.point.normal, direction));
  return cosine > 0 ? at.uv_per_length * width / std::sqrt(cosine) : 0;
}

Scattering scatter_at(const World& world, const TextureStore& textures, const Hit& hit,
                      const SurfaceInteraction& at, const Vec3& wo, float footprint) {
  const Material& material = world.materials[at.surface->material];
  // Light that passes through must start at the facet, or it would hit the facet again.
  const bool curved = at.curved && !std::holds_alternative<GlassMaterial>(material.model);
  const float lift = curved ? at.lift(wo) : 0;
  const Vec3 surface = curved ? visible_normal(at.normal, at.point.normal, wo) : at.point.normal;
  Vec3 normal = curved ? surface : at.normal;
  bool tilted = at.smooth && !curved;
  if (material.normal_map != no_texture) {
    Vec3 mapped = mapped_normal(material, textures, at.uv, footprint);
    if (at.mirrored) mapped.y = -mapped.y;
    normal = glm::normalize(make_frame(normal, at.tangent).world_from_local(mapped));
    tilted = true;
  }
  if (tilted) normal = visible_normal(normal, at.point.normal, wo);

  const ShadingFrame frame = make_frame(normal);
  const Vec3 local_wo = frame.local_from_world(wo);
  const SurfacePoint from = lift != 0 ? lifted_point(at, lift) : at.point;
  Scattering s{
      .bsdf = resolve_material(material, textures, at.uv, footprint,
                               material.vertex_colors ? vertex_color_at(world, hit) : Vec3(1)),
      .frame = frame,
      .wo = local_wo,
      .world_wo = wo,
      .smooth = false,
      .tilted = tilted,
      .lifted = lift != 0,
      .from = from,
      .surface = surface,
      .lit = {from.position, local_wo.z < 0 ? -normal : normal, false}};
  s.smooth = has_smooth_lobes(s.bsdf);
  s.lit.transmits = std::holds_alternative<GlassBsdf>(s.bsdf);
  return s;
}

}  // namespace

PathTracer::PathTracer(const World& world, const Accelerator& accelerator,
                       const TextureStore& textures, const FilmSettings& film,
                       const RenderSettings& settings, bool count_traversal)
    : world_(world),
      accelerator_(accelerator),
      textures_(textures),
      settings_(settings),
      camera_(world.camera, film),
      lights_(world, textures),
      textured_(!world.textures.empty()),
      keys_(static_cast<std::uint32_t>(std::clamp<std::size_t>(lights_.size(), 1, most_keys))),
      count_traversal_(count_traversal) {
  for (const Material& material : world.materials) {
    masked_.push_back(is_masked(material) ? 1 : 0);
  }
  for (const Surface& surface : world.surfaces) {
    any_masked_ = any_masked_ || masked_[surface.material] != 0;
  }
  const bool lit = !lights_.sampler().empty();
  const bool several = lit && lights_.sampler().only() == no_light;
  // Opacity; light, its triangle and a point on it; lobe and direction; roulette.
  dimensions_ = (any_masked_ ? 1 : 0) + (several ? 1 : 0) + (lit ? 2 : 0) + 2 + 1;
}

PathBatch PathTracer::make_batch(std::size_t capacity) const { return {capacity, keys_}; }

TraversalCounts* PathTracer::traversal(PathBatch& batch, RayKind kind) const {
  return count_traversal_ ? &batch.counts.traversal[static_cast<std::size_t>(kind)] : nullptr;
}

void PathTracer::trace(const PixelRect& tile, int first, int count, PathBatch& batch,
                       Film& film) const {
  generate(tile, first, count, batch);
  RayKind kind = RayKind::camera;
  while (batch.active > 0) {
    intersect(batch, kind);
    shade(batch);
    resolve_shadows(batch);
    kind = RayKind::bounce;
  }
  accumulate(tile, count, batch, film);
}

void PathTracer::generate(const PixelRect& tile, int first, int count, PathBatch& batch) const {
  const auto per_pixel = static_cast<std::size_t>(count);
  const auto width = static_cast<std::size_t>(tile.x1 - tile.x0);
  const std::size_t all = per_pixel * width * static_cast<std::size_t>(tile.y1 - tile.y0);
  const std::uint32_t dimensions = camera_.dimensions();
  std::array<glm::ivec2, DrawnNumbers::lanes> pixels{};
  for (std::size_t begin = 0; begin < all; begin += DrawnNumbers::lanes) {
    const std::size_t end = std::min(begin + DrawnNumbers::lanes, all);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t pixel = i / per_pixel;
      const int x = tile.x0 + static_cast<int>(pixel % width);
      const int y = tile.y0 + static_cast<int>(pixel / width);
      const int k = first + static_cast<int>(i % per_pixel);
      Path& path = batch.paths[i];
      path = {};
      path.sampler = Sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                             static_cast<std::uint32_t>(k), settings_.seed);
      path.slot = static_cast<std::uint32_t>(i);
      batch.numbers.set(i - begin, path.sampler);
      path.sampler.skip(dimensions);
      pixels[i - begin] = {x, y};
    }
    batch.numbers.draw(dimensions);
    for (std::size_t i = begin; i < end; ++i) {
      NumberReader numbers(batch.numbers, i - begin);
      const CameraRay camera_ray =
          camera_.generate(pixels[i - begin].x, pixels[i - begin].y, numbers);
      batch.paths[i].cone_width = camera_ray.cone_width;
      batch.paths[i].cone_spread = camera_ray.cone_spread;
      batch.rays[i] = camera_ray.ray;
      batch.samples[i] = {};
    }
  }
  batch.active = all;
}

void PathTracer::intersect(PathBatch& batch, RayKind kind) const {
  accelerator_.closest_hit({batch.rays.data(), batch.active}, {batch.hits.data(), batch.active},
                           traversal(batch, kind));
  batch.counts.rays[static_cast<std::size_t>(kind)] += batch.active;
}

// Compacts the surviving paths, so that the next rays have no gaps.
void PathTracer::shade(PathBatch& batch) const {
  std::size_t kept = 0;
  batch.shadows = 0;
  for (std::size_t begin = 0; begin < batch.active; begin += DrawnNumbers::lanes) {
    const std::size_t end = std::min(begin + DrawnNumbers::lanes, batch.active);
    for (std::size_t i = begin; i < end; ++i) {
      batch.numbers.set(i - begin, batch.paths[i].sampler);
    }
    batch.numbers.draw(dimensions_);
    for (std::size_t i = begin; i < end; ++i) {
      NumberReader numbers(batch.numbers, i - begin);
      if (!shade_path(batch.paths[i], batch.rays[i], batch.hits[i], numbers, batch)) continue;
      batch.paths[i].sampler.skip(numbers.used());
      if (kept != i) {
        batch.paths[kept] = batch.paths[i];
        batch.rays[kept] = batch.rays[i];
      }
      ++kept;
    }
  }
  batch.active = kept;
}

bool PathTracer::shade_path(Path& path, Ray& ray, const Hit& hit, NumberReader& numbers,
                            PathBatch& batch) const {
  PathSample& sample = batch.samples[path.slot];
  if (!hit.valid()) {
    add_distant(path, ray, sample);
    return false;
  }
  const SurfaceInteraction at = interact(world_, hit);
  path.cone_width += path.cone_spread * hit.t;
  if (path.depth == 0) path.length += hit.t;
  const float footprint = textured_ ? footprint_on(at, ray.direction, path.cone_width) : 0;

  if (any_masked_ && masked_[at.surface->material] != 0) {
    const float stopped =
        opacity(world_.materials[at.surface->material], textures_, at.uv, footprint);
    if (numbers.next_1d() >= stopped) {
      ray = spawn_ray(at.point, ray.direction);
      return ++path.passes < most_passes;
    }
  }
  if (at.surface->light != no_light) add_emission(path, ray, hit, at, sample);
  if (path.depth == 0) sample.depth = path.length;
  if (path.depth >= settings_.max_depth) return false;
  ++path.depth;

  const Scattering scattering = scatter_at(world_, textures_, hit, at, -ray.direction, footprint);
  if (scattering.smooth) {
    if (!path.features_found) {
      sample.albedo = albedo(scattering.bsdf);
      sample.normal = scattering.lit.normal;
      path.features_found = true;
    }
    gather_shadow(path, scattering, numbers, batch);
  }
  return scatter(path, ray, scattering, numbers);
}

// The MIS weight of light that a ray met by BSDF sampling. `light_pdf` is the density with which
// next-event estimation samples the same direction once it has chosen this light.
float PathTracer::emission_weight(const Path& path, float light_pdf, LightId light) const {
  if (path.bsdf_pdf == 0 || settings_.strategy == Strategy::bsdf) return 1;
  if (settings_.strategy == Strategy::nee) return 0;
  const float chosen = lights_.sampler().probability(path.from, light);
  return power_heuristic(path.bsdf_pdf, chosen * light_pdf);
}

void PathTracer::add_distant(const Path& path, const Ray& ray, PathSample& sample) const {
  for (const LightId light : lights_.visible_distant()) {
    const Vec3 radiance = lights_.distant_radiance(light, ray.direction);
    if (is_black(radiance)) continue;
    const float pdf = path.bsdf_pdf > 0 ? lights_.distant_pdf(light, path.from, ray.direction) : 0;
    sample.radiance += path.throughput * radiance * emission_weight(path, pdf, light);
  }
}

void PathTracer::add_emission(const Path& path, const Ray& ray, const Hit& hit,
                              const SurfaceInteraction& at, PathSample& sample) const {
  const LightId light = at.surface->light;
  const Vec3 radiance = lights_.emitted(light, at.point.normal, -ray.direction, at.uv);
  if (is_black(radiance)) return;
  const float pdf = path.bsdf_pdf > 0 ? lights_.area_pdf(light, path.from, hit.triangle,
                                                         at.point.position, at.point.normal)
                                      : 0;
  sample.radiance += path.throughput * radiance * emission_weight(path, pdf, light);
}

// Next-event estimation: chooses one light and one direction, and adds one shadow segment to the
// batch.
void PathTracer::gather_shadow(const Path& path, const Scattering& scattering,
                               NumberReader& numbers, PathBatch& batch) const {
  if (lights_.sampler().empty()) return;
  const float u_choice = lights_.sampler().only() == no_light ? numbers.next_1d() : 0;
  const auto choice = lights_.sampler().choose(scattering.lit, u_choice);
  const float u = numbers.next_1d();
  const Vec2 u2 = numbers.next_2d();
  if (!choice) return;
  const auto drawn = lights_.sample(choice->light, scattering.lit, {u, u2});
  if (!drawn || (settings_.strategy == Strategy::bsdf && !drawn->delta)) return;

  const Vec3 wi = scattering.frame.local_from_world(drawn->direction);
  if (!scattering.consistent(drawn->direction, wi)) return;
  Vec3 value = evaluate(scattering.bsdf, scattering.wo, wi);
  if (is_black(value)) return;
  if (scattering.tilted && scattering.wo.z * wi.z > 0) {
    value *= terminator_fade(scattering.frame.z, scattering.surface, drawn->direction);
  }
  if (any_masked_ && drawn->triangle != no_triangle) {
    value *= opacity_at(drawn->triangle, drawn->barycentrics, 0);
  }
  const float light_pdf = choice->probability * drawn->pdf;
  float weight = 1;
  if (settings_.strategy == Strategy::mis && !drawn->delta) {
    weight = power_heuristic(light_pdf, pdf(scattering.bsdf, scattering.wo, wi));
  }
  const Vec3 contribution = path.throughput * value * drawn->radiance * (weight / light_pdf);
  if (is_black(contribution)) return;

  const Vec3& side = scattering.side(drawn->direction, wi);
  batch.shadow_tasks[batch.shadows] = {contribution, path.slot};
  if (drawn->distant) {
    Ray& ray = batch.shadow_rays[batch.shadows];
    assign(ray, spawn_ray(scattering.from, drawn->direction, side));
    ray.bundle = choice->light;
  } else {
    assign(batch.shadow_rays[batch.shadows],
           spawn_segment(scattering.from, drawn->target, drawn->target_error, choice->light, side));
  }
  ++batch.shadows;
}

bool PathTracer::scatter(Path& path, Ray& ray, const Scattering& scattering,
                         NumberReader& numbers) const {
  const float u = numbers.next_1d();
  const Vec2 u2 = numbers.next_2d();
  const auto drawn = sample(scattering.bsdf, scattering.wo, u, u2);
  if (!drawn) return false;
  // After the last interaction a ray matters only if it may meet a light.
  if (path.depth >= settings_.max_depth) {
    const bool counts = drawn->specular || settings_.strategy != Strategy::nee;
    if (!counts || !lights_.any_visible()) return false;
  }
  const Vec3 direction = glm::normalize(scattering.frame.world_from_local(drawn->wi));
  if (!scattering.consistent(direction, drawn->wi)) return false;
  path.throughput *= drawn->weight;
  if (scattering.tilted && !drawn->specular && !drawn->transmission) {
    path.throughput *= terminator_fade(scattering.frame.z, scattering.surface, direction);
  }
  if (is_black(path.throughput)) return false;
  path.bsdf_pdf = drawn->specular ? 0 : drawn->pdf;
  path.from = scattering.lit;
  if (const auto* glass = std::get_if<GlassBsdf>(&scattering.bsdf);
      glass != nullptr && drawn->transmission) {
    const float eta = scattering.wo.z > 0 ? glass->eta : 1 / glass->eta;
    path.eta_scale *= eta * eta;
  }
  // A scattered ray represents the directions near it: its cone gets a quarter of the angle that
  // its density spans.
  if (textured_ && !drawn->specular) {
    path.cone_spread += 0.25F / std::sqrt(std::numbers::pi_v<float> * drawn->pdf);
  }
  if (path.depth >= settings_.roulette_depth) {
    const Vec3 weight = path.throughput * path.eta_scale;
    const float survival = std::max({weight.x, weight.y, weight.z});
    if (survival < 1) {
      if (numbers.next_1d() >= survival) return false;
      path.throughput /= survival;
    }
  }
  assign(ray, spawn_ray(scattering.from, direction, scattering.side(direction, drawn->wi)));
  return true;
}

void PathTracer::accumulate(const PixelRect& tile, int count, PathBatch& batch, Film& film) const {
  std::size_t i = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      FilmPixel& pixel = film.at(x, y);
      FilmFeatures* const features = film.features_at(x, y);
      for (int k = 0; k < count; ++k, ++i) {
        const PathSample& sample = batch.samples[i];
        if (!acceptable(sample.radiance)) {
          ++batch.counts.nan_samples;
          continue;
        }
        pixel.add_radiance(DVec3(sample.radiance));
        const bool hit = sample.depth >= 0;
        if (features != nullptr) {
          features->albedo += DVec3(sample.albedo);
          features->normal += DVec3(sample.normal);
          if (hit) features->depth += static_cast<double>(sample.depth);
        }
        if (hit) ++pixel.hits;
        ++pixel.samples;
      }
    }
  }
}

}  // namespace pah
