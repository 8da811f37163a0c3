#include <fmt/format.h>

#include <array>
#include <limits>
#include <pah/render/film_file.hpp>
#include <stdexcept>
#include <utility>

#include "base/output_file.hpp"
#include "render/film/word_file.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t magic = 0x0A4D4C4946484150ULL;  // "PAHFILM\n"
constexpr int format_version = 1;
constexpr int max_int = std::numeric_limits<int>::max();
constexpr int max_side = 65536;  // as a scene may ask for
constexpr std::uint64_t max_text = 256;
constexpr std::uint64_t pixel_words = 10, feature_words = 7;

constexpr std::array<const char*, 3> strategy_names{"mis", "nee", "bsdf"};
constexpr std::array<const char*, 2> filter_names{"blackman_harris", "box"};

std::string described(const PixelRect& rect) {
  return fmt::format("{},{},{},{}", rect.x0, rect.x1, rect.y0, rect.y1);
}

using Facts = std::vector<std::pair<const char*, std::string>>;

Facts facts_of(const FilmOrigin& origin) {
  const FilmSettings& film = origin.film;
  const RenderSettings& render = origin.render;
  return {
      {"the version of pahrender", origin.version},
      {"the scene (its text, the files that it names and -D)", origin.scene_hash},
      {"the width", std::to_string(film.width)},
      {"the height", std::to_string(film.height)},
      {"the crop", described(pixels_of(film))},
      {"the seed", std::to_string(render.seed)},
      {"the strategy", strategy_names.at(static_cast<std::size_t>(render.strategy))},
      {"max_depth", std::to_string(render.max_depth)},
      {"roulette_depth", std::to_string(render.roulette_depth)},
      {"the filter", filter_names.at(static_cast<std::size_t>(film.filter))},
      {"the radius of the filter", fmt::format("{}", film.filter_radius)},
      {"the layers kept beside the picture", keeps_features(film) ? "features" : "nothing"},
  };
}

constexpr std::size_t facts_of_scene = 2;  // the first ones

void put_rect(WordWriter& writer, const PixelRect& rect) {
  for (const int bound : {rect.x0, rect.x1, rect.y0, rect.y1}) writer.put_int(bound);
}

void put_origin(WordWriter& writer, const FilmOrigin& origin) {
  writer.put_text(origin.version);
  writer.put_text(origin.scene_hash);
  const FilmSettings& film = origin.film;
  writer.put_int(film.width);
  writer.put_int(film.height);
  put_rect(writer, pixels_of(film));
  writer.put_int(static_cast<int>(film.filter));
  writer.put_double(film.filter_radius);
  writer.put_double(film.exposure);
  for (const bool layer : {film.albedo, film.normal, film.depth, film.variance})
    writer.put_int(layer ? 1 : 0);
  const RenderSettings& render = origin.render;
  for (const int value : {render.samples, render.max_depth, render.roulette_depth})
    writer.put_int(value);
  writer.put(render.seed);
  writer.put_int(static_cast<int>(render.strategy));
}

void put_samples(WordWriter& writer, const FilmSamples& samples) {
  for (const int value : {samples.from, samples.to, samples.ahead}) writer.put_int(value);
  writer.put(samples.behind.size());
  for (const std::size_t tile : samples.behind) writer.put(tile);
}

void put_vector(WordWriter& writer, const DVec3& vector) {
  for (int i = 0; i < 3; ++i) writer.put_double(vector[i]);
}

void put_film(WordWriter& writer, const Film& film) {
  for (const FilmPixel& pixel : film.pixels) {
    put_vector(writer, pixel.sum);
    put_vector(writer, pixel.error);
    put_vector(writer, pixel.sum_of_squares);
    writer.put(pixel.samples | std::uint64_t{pixel.hits} << 32);
  }
  for (const FilmFeatures& features : film.features) {
    put_vector(writer, features.albedo);
    put_vector(writer, features.normal);
    writer.put_double(features.depth);
  }
}

std::size_t pixel_count(const PixelRect& rect) {
  return static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
}

void check_film(const FilmOrigin& origin, const Film& film) {
  const std::size_t pixels = pixel_count(pixels_of(origin.film));
  if (described(film.rect) != described(pixels_of(origin.film)) || film.pixels.size() != pixels ||
      film.features.size() != (keeps_features(origin.film) ? pixels : 0))
    throw std::invalid_argument("the film does not match its settings");
}

PixelRect read_rect(WordReader& reader, int width, int height) {
  PixelRect rect;
  rect.x0 = reader.integer(0, width - 1);
  rect.x1 = reader.integer(rect.x0 + 1, width);
  rect.y0 = reader.integer(0, height - 1);
  rect.y1 = reader.integer(rect.y0 + 1, height);
  return rect;
}

FilmSettings read_film_settings(WordReader& reader) {
  FilmSettings film;
  film.width = reader.integer(1, max_side);
  film.height = reader.integer(1, max_side);
  const PixelRect rect = read_rect(reader, film.width, film.height);
  if (described(rect) != described(pixels_of(film))) film.crop = rect;
  film.filter = static_cast<PixelFilter>(reader.integer(0, int{filter_names.size()} - 1));
  film.filter_radius = reader.number();
  film.exposure = reader.number();
  for (bool* layer : {&film.albedo, &film.normal, &film.depth, &film.variance})
    *layer = reader.integer(0, 1) == 1;
  return film;
}

RenderSettings read_render_settings(WordReader& reader) {
  RenderSettings render;
  for (int* value : {&render.samples, &render.max_depth, &render.roulette_depth})
    *value = reader.integer(0, max_int);
  render.seed = reader.word();
  render.strategy = static_cast<Strategy>(reader.integer(0, int{strategy_names.size()} - 1));
  return render;
}

FilmOrigin read_origin(WordReader& reader) {
  FilmOrigin origin;
  origin.version = reader.text(max_text);
  origin.scene_hash = reader.text(max_text);
  origin.film = read_film_settings(reader);
  origin.render = read_render_settings(reader);
  return origin;
}

// Reads everything but `behind`, and returns the size of `behind`.
std::uint64_t read_samples(WordReader& reader, FilmSamples& samples) {
  samples.from = reader.integer(0, max_int);
  samples.to = reader.integer(samples.from, max_int);
  samples.ahead = reader.integer(0, max_int - samples.to);
  return reader.word();
}

DVec3 read_vector(WordReader& reader) {
  DVec3 vector;
  for (int i = 0; i < 3; ++i) vector[i] = reader.number();
  return vector;
}

FilmPixel read_pixel(WordReader& reader) {
  FilmPixel pixel;
  pixel.sum = read_vector(reader);
  pixel.error = read_vector(reader);
  pixel.sum_of_squares = read_vector(reader);
  const std::uint64_t counts = reader.word();
  pixel.samples = static_cast<std::uint32_t>(counts);
  pixel.hits = static_cast<std::uint32_t>(counts >> 32);
  return pixel;
}

FilmFeatures read_features(WordReader& reader) {
  FilmFeatures features;
  features.albedo = read_vector(reader);
  features.normal = read_vector(reader);
  features.depth = reader.number();
  return features;
}

}  // namespace

std::vector<std::string> differences(const FilmOrigin& found, const FilmOrigin& wanted) {
  const Facts ours = facts_of(found);
  const Facts theirs = facts_of(wanted);
  std::vector<std::string> result;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (ours[i].second != theirs[i].second)
      result.push_back(
          fmt::format("{} is {}, not {}", ours[i].first, ours[i].second, theirs[i].second));
  return result;
}

std::string describe_settings(const FilmOrigin& origin) {
  const Facts facts = facts_of(origin);
  std::string text;
  for (std::size_t i = facts_of_scene; i < facts.size(); ++i)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", facts[i].first, facts[i].second);
  return text;
}

void write_film(const fs::path& file, const FilmOrigin& origin, const FilmSamples& samples,
                const Film& film) {
  check_film(origin, film);
  const fs::path temporary = temporary_beside(file);
  try {
    WordWriter writer(temporary, file);
    writer.put(magic);
    writer.put_int(format_version);
    put_origin(writer, origin);
    put_samples(writer, samples);
    put_film(writer, film);
    writer.finish();
  } catch (const FileError&) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  put_in_place(temporary, file);
}

FilmFile read_film(const fs::path& file) {
  WordReader reader(file);
  if (reader.word() != magic) reader.fail("is not a pahrender film");
  if (const std::uint64_t found = reader.word(); found != format_version)
    reader.fail(fmt::format("has format {}; this version of pahrender reads format {}", found,
                            format_version));
  FilmFile result;
  result.origin = read_origin(reader);
  const std::uint64_t behind = read_samples(reader, result.samples);

  // Checked before allocating, so that a damaged file cannot ask for more memory than it holds.
  const std::size_t pixels = pixel_count(pixels_of(result.origin.film));
  const std::size_t features = keeps_features(result.origin.film) ? pixels : 0;
  if (behind > pixels) reader.fail_as_damaged();
  reader.check_left(behind + pixel_words * pixels + feature_words * features);

  for (std::uint64_t i = 0; i < behind; ++i) result.samples.behind.push_back(reader.word());
  Film& film = result.film;
  film.rect = pixels_of(result.origin.film);
  film.pixels.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) film.pixels.push_back(read_pixel(reader));
  film.features.reserve(features);
  for (std::size_t i = 0; i < features; ++i) film.features.push_back(read_features(reader));
  reader.check_end();
  return result;
}

}  // namespace pah
