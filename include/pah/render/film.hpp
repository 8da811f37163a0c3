// The film of a render: double-precision sums per pixel.
#pragma once

#include <cstdint>
#include <pah/geometry/vec.hpp>
#include <pah/image/image.hpp>
#include <pah/scene/settings.hpp>
#include <vector>

namespace pah {

// Each sample belongs to one pixel only (the filter is importance-sampled), so a pixel's mean is
// its sum over its count, and tiles never share pixels.
struct FilmPixel {
  DVec3 sum{0};
  DVec3 error{0};  // of `sum` by rounding, to be added to it
  DVec3 sum_of_squares{0};
  std::uint32_t samples = 0;
  std::uint32_t hits = 0;  // samples whose camera ray met a surface

  // Adds a sample's radiance, but does not count it. Float radiances are added without any error,
  // as long as the largest is less than some 2^50 times the least.
  void add_radiance(const DVec3& radiance) {
    add_to_sum(radiance);
    sum_of_squares += radiance * radiance;
  }
  // Adds the samples of another film's pixel, also without error in the radiance.
  void add(const FilmPixel& other) {
    add_to_sum(other.sum);
    error += other.error;
    sum_of_squares += other.sum_of_squares;
    samples += other.samples;
    hits += other.hits;
  }
  [[nodiscard]] DVec3 radiance() const { return sum + error; }  // of all samples

 private:
  void add_to_sum(const DVec3& radiance) {
    // Knuth, The Art of Computer Programming 2, 4.2.2, theorem B.
    const DVec3 total = sum + radiance;
    const DVec3 added = total - sum;
    error += (sum - (total - added)) + (radiance - added);
    sum = total;
  }
};

// The sums of the further layers of a pixel.
struct FilmFeatures {
  DVec3 albedo{0};  // sums, at the first non-specular surface
  DVec3 normal{0};
  double depth = 0;  // sum of distances from the camera, over the pixel's `hits`

  [[nodiscard]] bool operator==(const FilmFeatures&) const = default;
};

struct Film {
  PixelRect rect;  // the pixels held, in picture coordinates
  std::vector<FilmPixel> pixels;
  std::vector<FilmFeatures> features;  // of each pixel; empty if no layer needs them

  [[nodiscard]] FilmPixel& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const FilmPixel& at(int x, int y) const { return pixels[index(x, y)]; }
  // Null if the film keeps no features.
  [[nodiscard]] FilmFeatures* features_at(int x, int y) {
    return features.empty() ? nullptr : &features[index(x, y)];
  }
  [[nodiscard]] const FilmFeatures* features_at(int x, int y) const {
    return features.empty() ? nullptr : &features[index(x, y)];
  }
  [[nodiscard]] std::size_t bytes() const {
    return pixels.size() * sizeof(FilmPixel) + features.size() * sizeof(FilmFeatures);
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
           static_cast<std::size_t>(x - rect.x0);
  }
};

// A film without samples.
[[nodiscard]] Film black_film(const PixelRect& rect, bool with_features);

// Adds other samples of the same pixels, or of some of them. Neither the split of samples nor their
// order changes a bit of the picture; features and the variance agree within the rounding of
// doubles.
void add(Film& sum, const Film& other);

// Whether the settings ask for a layer that needs features.
[[nodiscard]] bool keeps_features(const FilmSettings& settings);

// The memory of a film, in bytes for each pixel.
[[nodiscard]] std::size_t bytes_per_pixel(const FilmSettings& settings);

// Means. A pixel without samples is black, as are features that the film does not keep.
[[nodiscard]] Image radiance_of(const Film& film);
// The same for some pixels of the film; reads no others.
[[nodiscard]] Image radiance_of(const Film& film, const PixelRect& rect);
[[nodiscard]] Image albedo_of(const Film& film);
[[nodiscard]] Image normal_of(const Film& film);
// Distances in all three channels; 0 where nothing was hit.
[[nodiscard]] Image depth_of(const Film& film);
// The variance of the mean, per channel, from the samples' spread as if they were independent. A
// pixel's samples are stratified, so the true variance is no larger: this is an upper estimate.
// 0 for a pixel with fewer than two samples.
[[nodiscard]] Image variance_of(const Film& film);

// The mean number of samples of a pixel, without dropped ones.
[[nodiscard]] double mean_samples(const Film& film);

// The error that the image's own variance predicts, an upper estimate like the variance. The
// interval is for the relmse that a comparison with a perfect reference would find. Pixels with
// fewer than two samples are left out; if there are no others, the errors are infinite.
struct ErrorEstimate {
  double mse = 0;
  double relmse = 0;         // mean over pixels and channels of (I - R)^2 / (R^2 + 0.01)
  double low = 0, high = 0;  // 95 % confidence interval of relmse
};
[[nodiscard]] ErrorEstimate estimate_error(const Film& film);

}  // namespace pah
