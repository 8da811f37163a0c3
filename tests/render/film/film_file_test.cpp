#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pah/render/film_file.hpp>
#include <random>
#include <sstream>
#include <type_traits>

#include "catch.hpp"
#include "support/mutate.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace pah;

namespace {

FilmOrigin small_origin(bool features) {
  FilmOrigin origin{"1.2.3", "0123456789abcdef", {}, {}};
  origin.film.width = 7;
  origin.film.height = 5;
  origin.film.crop = PixelRect{1, 4, 2, 4};
  origin.film.depth = features;
  origin.film.exposure = -0.3;
  origin.render.seed = 0xFEDCBA9876543210ULL;
  origin.render.strategy = Strategy::bsdf;
  return origin;
}

Film random_film(const FilmOrigin& origin) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> number;
  const auto vector = [&] { return DVec3(number(random), number(random), number(random)); };
  Film film;
  film.rect = pixels_of(origin.film);
  film.pixels.resize(static_cast<std::size_t>(film.rect.width() * film.rect.height()));
  for (FilmPixel& pixel : film.pixels)
    pixel = {vector(), 1e-17 * vector(), vector(), static_cast<std::uint32_t>(random()),
             static_cast<std::uint32_t>(random())};
  if (keeps_features(origin.film)) film.features.resize(film.pixels.size());
  for (FilmFeatures& features : film.features) features = {vector(), vector(), number(random)};
  film.pixels[0].sum = DVec3(-0.0, 5e-324, 1e308);
  return film;
}

const FilmSamples some_samples{3, 19, 16, {0, 2}};

std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string film_bytes(bool features) {
  const FilmOrigin origin = small_origin(features);
  write_film("good.film", origin, some_samples, random_film(origin));
  return bytes_of("good.film");
}

std::string error_of(const std::string& bytes) {
  write_bytes("bad.film", bytes);
  try {
    (void)read_film("bad.film");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

template <class Value>
bool same_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % 8 == 0);
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

}  // namespace

TEST_CASE("A film is read as it was written, to the last bit") {
  const CurrentTemporaryFolder folder;
  for (const bool features : {false, true}) {
    const FilmOrigin origin = small_origin(features);
    const Film film = random_film(origin);
    write_film("a.film", origin, some_samples, film);
    const FilmFile read = read_film("a.film");
    CHECK(differences(read.origin, origin).empty());
    CHECK(read.origin.film.exposure == origin.film.exposure);
    CHECK(read.origin.film.depth == features);
    CHECK(read.samples == some_samples);
    CHECK(same_bytes(read.film.pixels, film.pixels));
    CHECK(read.film.features == film.features);
    write_film("b.film", read.origin, read.samples, read.film);
    CHECK(bytes_of("a.film") == bytes_of("b.film"));
    CHECK(std::distance(fs::directory_iterator("."), fs::directory_iterator()) == 2);
    fs::remove("b.film");
  }
}

TEST_CASE("Every byte of a film that is changed is found") {
  const CurrentTemporaryFolder folder;
  const std::string good = film_bytes(true);
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const int change : {0x01, 0x80, 0xFF}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ change);
      CAPTURE(at, change);
      const std::string error = error_of(bad);
      REQUIRE(contains(error, "bad.film "));
      if (at < 8) REQUIRE(contains(error, "not a pahrender film"));
      if (at >= 8 && at < 16) REQUIRE(contains(error, "reads format 1"));
    }
}

TEST_CASE("A film that is cut short or has more at its end is found") {
  const CurrentTemporaryFolder folder;
  const std::string good = film_bytes(false);
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    REQUIRE(contains(error_of(good.substr(0, size)), "is cut short"));
  }
  for (const std::size_t more : {1, 7, 8, 100})
    CHECK(contains(error_of(good + std::string(more, '\0')), "bytes follow its end"));
}

TEST_CASE("Wrong sizes in a film file are found before anything is allocated") {
  const CurrentTemporaryFolder folder;
  FilmOrigin origin = small_origin(true);
  origin.film.width = 61;
  origin.film.height = 53;
  origin.film.crop.reset();
  write_film("good.film", origin, {}, random_film(origin));
  std::string bytes = bytes_of("good.film");
  for (std::size_t at = 0; at < bytes.size(); at += 8)
    for (const char side : {61, 53})
      if (bytes.substr(at, 8) == side + std::string(7, '\0'))
        bytes.replace(at, 8, std::string("\0\0\1\0\0\0\0\0", 8));
  CHECK(contains(error_of(bytes), "is cut short: it has "));
}

TEST_CASE("A wrong number in a film file is found") {
  const CurrentTemporaryFolder folder;
  const std::string good = film_bytes(false);
  for (std::size_t at = 0; at + 8 <= good.size(); at += 8)
    for (const std::uint64_t lie :
         {0ULL, 1ULL, 65536ULL, 1ULL << 30, 1ULL << 40, 1ULL << 61, ~0ULL}) {
      std::string bad = good;
      for (std::size_t i = 0; i < 8; ++i) bad[at + i] = static_cast<char>(lie >> (8 * i));
      CAPTURE(at, lie);
      if (bad != good) REQUIRE(!error_of(bad).empty());
    }
}

TEST_CASE("Any bytes are read as a film or refused") {
  const CurrentTemporaryFolder folder;
  std::mt19937 random(3);
  const std::string good = film_bytes(true);
  for (int i = 0; i < 3000; ++i) {
    const std::string bad = mutated(good, random, "PAHFILM\n");
    if (bad != good) REQUIRE(!error_of(bad).empty());
  }
  CHECK_THROWS_AS(read_film("missing.film"), FileError);
  CHECK_THROWS_AS(read_film("."), FileError);
}

TEST_CASE("A film that cannot be written is an error, and leaves nothing") {
  const CurrentTemporaryFolder folder;
  const FilmOrigin origin = small_origin(false);
  CHECK_THROWS_AS(write_film("missing/a.film", origin, {}, random_film(origin)), FileError);
  fs::create_directory("folder.film");
  CHECK_THROWS_AS(write_film("folder.film", origin, {}, random_film(origin)), FileError);
  CHECK_THROWS_AS(write_film("a.film", origin, {}, Film{}), std::invalid_argument);
  CHECK(std::distance(fs::directory_iterator("."), fs::directory_iterator()) == 1);
}

TEST_CASE("Differences between the origins of films are named") {
  const FilmOrigin wanted = small_origin(true);
  FilmOrigin other = wanted;
  other.render.samples += 1;
  other.film.exposure += 1;
  CHECK(differences(other, wanted).empty());
  other.render.seed = 4;
  CHECK(differences(other, wanted) ==
        std::vector<std::string>{"the seed is 4, not 18364758544493064720"});
  other.version = "2";
  other.scene_hash = "x";
  other.film.width += 1;
  other.film.height += 1;
  other.film.crop->x1 -= 1;
  other.render.strategy = Strategy::mis;
  other.render.max_depth += 1;
  other.render.roulette_depth += 1;
  other.film.filter = PixelFilter::box;
  other.film.filter_radius = 0.1;
  other.film.depth = false;
  CHECK(differences(other, wanted).size() == 12);
}
