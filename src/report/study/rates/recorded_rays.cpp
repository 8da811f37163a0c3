#include "report/study/rates/recorded_rays.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <pah/render/session.hpp>
#include <random>

#include "geometry/rounding.hpp"

namespace pah {
namespace {

// Renders whole tiles of a picture of the scene's size, so that batches and the distances of rays
// are those of a real render. This number of pixels sees enough of a scene.
constexpr std::uint64_t recorded_pixels = 12ULL * 1024;
constexpr double most_pixels = 1 << 20;  // of the picture, because its film takes memory

// Records rays between the renderer and an accelerator. Not thread-safe.
class Recorder final : public Accelerator {
 public:
  Recorder(const World& world, const Accelerator& accelerator, RecordedRays& rays)
      : world_(world), accelerator_(accelerator), rays_(rays) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    if (!rays.empty()) kind_of(rays).add(rays);
    accelerator_.closest_hit(rays, hits, counts);
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    rays_.shadow.add(rays);
    accelerator_.occluded(rays, results, counts);
  }
  [[nodiscard]] AcceleratorMemory memory() const override { return accelerator_.memory(); }

 private:
  // Shadow rays need nearest hits if surfaces are partly transparent.
  [[nodiscard]] RayBatches& kind_of(std::span<const Ray> rays) const {
    const std::uint32_t bundle = rays.front().bundle;
    if (bundle == camera_bundle || all_leave_the_lens(rays)) return rays_.camera;
    return bundle == no_bundle ? rays_.bounce : rays_.shadow;
  }

  // Rays through a lens form no bundle.
  [[nodiscard]] bool all_leave_the_lens(std::span<const Ray> rays) const {
    const auto* camera = std::get_if<PerspectiveCamera>(&world_.camera);
    if (camera == nullptr || camera->aperture_radius == 0) return false;
    // Origins are sums of three vectors, with at most six roundings each.
    const double reach =
        camera->aperture_radius +
        double{rounding_bound(18)} * (glm::length(camera->position) + camera->aperture_radius);
    return std::ranges::all_of(rays, [&](const Ray& ray) {
      return ray.bundle == no_bundle && glm::distance(DVec3(ray.origin), camera->position) <= reach;
    });
  }

  const World& world_;
  const Accelerator& accelerator_;
  RecordedRays& rays_;
};

// Draws batches at random, because every second or third batch might have the same path depth.
RayBatches thinned(const RayBatches& all, std::uint64_t most, std::uint64_t seed) {
  if (all.rays.size() <= most) return all;
  std::vector<std::size_t> order(all.ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  std::size_t kept = 0;
  std::size_t rays = 0;
  while (rays < most) rays += all.batch(order[kept++]).size();
  order.resize(kept);
  std::ranges::sort(order);
  RayBatches some;
  for (const std::size_t i : order) some.add(all.batch(i));
  return some;
}

// Keeps the rays of each batch that lead to a light with an exact bundle.
RayBatches to_exact_bundles(const RayBatches& shadow, const World& world) {
  std::vector<std::uint8_t> exact(world.lights.size());
  std::ranges::transform(world.lights, exact.begin(), [](const Light& light) -> std::uint8_t {
    return exact_bundle(light) ? 1 : 0;
  });
  RayBatches some;
  for (std::size_t i = 0; i < shadow.ends.size(); ++i) {
    std::vector<Ray> batch;
    std::ranges::copy_if(shadow.batch(i), std::back_inserter(batch),
                         [&](const Ray& ray) { return exact[ray.bundle] != 0; });
    some.add(batch);
  }
  return some;
}

FilmSettings picture_of(const FilmSettings& film) {
  FilmSettings picture = film;
  picture.crop.reset();
  const double all = static_cast<double>(film.width) * film.height;
  const double scale = std::min(1.0, std::sqrt(most_pixels / all));
  picture.width = std::max(1, static_cast<int>(film.width * scale));
  picture.height = std::max(1, static_cast<int>(film.height * scale));
  return picture;
}

std::uint64_t pixels_of(const PixelRect& tile) {
  return static_cast<std::uint64_t>(tile.width()) * static_cast<std::uint64_t>(tile.height());
}

// Chooses one tile from each of several equal parts, enough for the given number of pixels.
std::vector<std::size_t> some_tiles(std::span<const PixelRect> tiles, std::uint64_t seed) {
  std::uint64_t all = 0;
  for (const PixelRect& tile : tiles) all += pixels_of(tile);
  const std::size_t count =
      std::clamp<std::size_t>(tiles.size() * recorded_pixels / all, 1, tiles.size());
  std::mt19937_64 random(seed);
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * tiles.size() / count;
    const std::size_t end = (i + 1) * tiles.size() / count;
    some.push_back(first + random() % (end - first));
  }
  return some;
}

int samples_for(std::span<const PixelRect> tiles, std::span<const std::size_t> some,
                std::uint64_t camera_rays) {
  std::uint64_t count = 0;
  for (const std::size_t i : some) count += pixels_of(tiles[i]);
  return static_cast<int>(
      std::clamp<std::uint64_t>(camera_rays / count, 1, RenderSession::batch_samples));
}

}  // namespace

RecordedRays record_rays(const World& world, const Accelerator& accelerator,
                         const FilmSettings& film, const RenderSettings& render, std::uint64_t most,
                         std::uint64_t seed) {
  RecordedRays rays;
  const Recorder recorder(world, accelerator, rays);
  RenderSession session(world, recorder, picture_of(film), render, {.threads = 1});
  const std::vector<std::size_t> tiles = some_tiles(session.tiles(), seed);
  session.render_pass(tiles, 0, samples_for(session.tiles(), tiles, most));
  rays.shadow_to_point_or_sun = to_exact_bundles(rays.shadow, world);
  for (RayBatches* kind : {&rays.camera, &rays.bounce, &rays.shadow, &rays.shadow_to_point_or_sun})
    *kind = thinned(*kind, most, seed);
  return rays;
}

}  // namespace pah
