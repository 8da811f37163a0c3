#include "batches.hpp"

#include <pah/render/render.hpp>
#include <stdexcept>

namespace pah::golden {
namespace {

std::size_t pixels_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::vector<DVec3> means_of(const Film& film) {
  std::vector<DVec3> means;
  means.reserve(film.pixels.size());
  for (const FilmPixel& pixel : film.pixels)
    means.push_back(pixel.radiance() / static_cast<double>(pixel.samples));
  return means;
}

}  // namespace

Batches::Batches(int width, int height)
    : width_(width),
      height_(height),
      mean_(pixels_of(width, height)),
      squares_(pixels_of(width, height)) {}

Batches::Batches(int width, int height, int count, std::vector<DVec3> mean,
                 const std::vector<DVec3>& variance)
    : width_(width), height_(height), count_(count), mean_(std::move(mean)) {
  squares_.reserve(variance.size());
  for (const DVec3& v : variance) squares_.push_back(v * static_cast<double>(count - 1));
}

// Welford, "Note on a method for calculating corrected sums of squares and products" (1962).
void Batches::add(const std::vector<DVec3>& picture) {
  ++count_;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const DVec3 before = picture[i] - mean_[i];
    mean_[i] += before / static_cast<double>(count_);
    squares_[i] += before * (picture[i] - mean_[i]);
  }
}

Batches render_batches(const Scene& scene, std::uint64_t first_seed, int count,
                       std::unique_ptr<Accelerator> (*make_accelerator)(Triangles)) {
  const World world = make_world(scene);
  const auto accelerator = make_accelerator(world.triangles());
  Batches batches(scene.film.width, scene.film.height);
  RenderSettings settings = scene.render;
  for (int i = 0; i < count; ++i) {
    settings.seed = first_seed + static_cast<std::uint64_t>(i);
    const RenderResult result = render(world, *accelerator, scene.film, settings);
    if (result.counts.nan_samples != 0)
      throw std::runtime_error(std::to_string(result.counts.nan_samples) +
                               " samples are not finite");
    batches.add(means_of(result.film));
  }
  return batches;
}

}  // namespace pah::golden
