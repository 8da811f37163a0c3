#include <algorithm>
#include <cmath>
#include <limits>
#include <pah/render/film.hpp>
#include <stdexcept>

namespace pah {
namespace {

template <class Value>
Image image_of(const Film& film, const Value& value) {
  Image image{film.rect.width(), film.rect.height(), {}};
  image.pixels.reserve(film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) image.pixels.push_back(Vec3(value(pixel)));
  return image;
}

template <class Value>
Image image_of_features(const Film& film, const Value& value) {
  auto features = film.features.begin();
  return image_of(film, [&](const FilmPixel& pixel) {
    return features == film.features.end() ? DVec3{0} : value(pixel, *features++);
  });
}

DVec3 over(const DVec3& sum, std::uint32_t count) {
  return count > 0 ? sum / static_cast<double>(count) : DVec3{0};
}

DVec3 mean_radiance(const FilmPixel& pixel) { return over(pixel.radiance(), pixel.samples); }

// The variance of a mean of n independent samples; 0 for fewer than two.
DVec3 variance_of_mean(const FilmPixel& pixel) {
  if (pixel.samples < 2) return DVec3{0};
  const auto n = static_cast<double>(pixel.samples);
  const DVec3 sum = pixel.radiance();
  const DVec3 squares = pixel.sum_of_squares - sum * (sum / n);
  return glm::max(squares, DVec3{0}) / (n * (n - 1));
}

}  // namespace

Film black_film(const PixelRect& rect, bool with_features) {
  Film film;
  film.rect = rect;
  film.pixels.resize(static_cast<std::size_t>(rect.width()) *
                     static_cast<std::size_t>(rect.height()));
  if (with_features) film.features.resize(film.pixels.size());
  return film;
}

void add(Film& sum, const Film& other) {
  const PixelRect& all = sum.rect;
  const PixelRect& some = other.rect;
  if (some.x0 < all.x0 || some.x1 > all.x1 || some.y0 < all.y0 || some.y1 > all.y1 ||
      sum.features.empty() != other.features.empty())
    throw std::invalid_argument("films to be added differ in what they hold");
  for (int y = some.y0; y < some.y1; ++y)
    for (int x = some.x0; x < some.x1; ++x) {
      sum.at(x, y).add(other.at(x, y));
      FilmFeatures* const features = sum.features_at(x, y);
      if (features == nullptr) continue;
      const FilmFeatures& added = *other.features_at(x, y);
      features->albedo += added.albedo;
      features->normal += added.normal;
      features->depth += added.depth;
    }
}

bool keeps_features(const FilmSettings& settings) {
  return settings.albedo || settings.normal || settings.depth;
}

std::size_t bytes_per_pixel(const FilmSettings& settings) {
  return sizeof(FilmPixel) + (keeps_features(settings) ? sizeof(FilmFeatures) : 0);
}

Image radiance_of(const Film& film) { return image_of(film, mean_radiance); }

Image radiance_of(const Film& film, const PixelRect& rect) {
  Image image{rect.width(), rect.height(), {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height));
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      image.pixels.push_back(Vec3(mean_radiance(film.at(x, y))));
  return image;
}

Image albedo_of(const Film& film) {
  return image_of_features(
      film, [](const FilmPixel& p, const FilmFeatures& f) { return over(f.albedo, p.samples); });
}

Image normal_of(const Film& film) {
  return image_of_features(
      film, [](const FilmPixel& p, const FilmFeatures& f) { return over(f.normal, p.samples); });
}

Image depth_of(const Film& film) {
  return image_of_features(
      film, [](const FilmPixel& p, const FilmFeatures& f) { return over(DVec3{f.depth}, p.hits); });
}

Image variance_of(const Film& film) { return image_of(film, variance_of_mean); }

double mean_samples(const Film& film) {
  std::uint64_t samples = 0;
  for (const FilmPixel& pixel : film.pixels) samples += pixel.samples;
  return film.pixels.empty()
             ? 0
             : static_cast<double>(samples) / static_cast<double>(film.pixels.size());
}

ErrorEstimate estimate_error(const Film& film) {
  double mse = 0;
  double relmse = 0;
  double squares = 0;
  std::uint64_t count = 0;
  double bias = 0;
  for (const FilmPixel& pixel : film.pixels) {
    if (pixel.samples < 2) continue;
    const DVec3 mean = mean_radiance(pixel);
    const DVec3 variance = variance_of_mean(pixel);
    // mean^2 exceeds the square of the true value by the variance, on average.
    const DVec3 reference = glm::max(mean * mean - variance, DVec3{0});
    const DVec3 relative = variance / (reference + 0.01);
    const double error = (relative.x + relative.y + relative.z) / 3;
    mse += (variance.x + variance.y + variance.z) / 3;
    relmse += error;
    squares += error * error;
    bias += error / pixel.samples;
    ++count;
  }
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (count == 0) return {unknown, unknown, 0, unknown};
  const auto n = static_cast<double>(count);
  mse /= n;
  relmse /= n;
  // By the central limit theorem over pixels. The spread of the predictions between pixels (their
  // noise, and what truly differs) is the first part; the second is that of the squared errors
  // themselves, whose variance is twice their squared mean for a normal error.
  const double spread = std::max(squares / n - relmse * relmse, 0.0) + 2 * squares / n;
  // The last is the bias of a ratio of two estimates, of relative order 1 / samples.
  const double margin = 1.96 * std::sqrt(spread / n) + bias / n;
  return {mse, relmse, std::max(relmse - margin, 0.0), relmse + margin};
}

}  // namespace pah
