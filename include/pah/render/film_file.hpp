// Films to and from files, to go on with or to add to others: with all their bits.
#pragma once

#include <filesystem>
#include <pah/base/errors.hpp>
#include <pah/render/film.hpp>
#include <pah/render/film_samples.hpp>
#include <pah/scene/settings.hpp>
#include <string>
#include <vector>

namespace pah {

// What a film comes from.
struct FilmOrigin {
  std::string version;     // of the program
  std::string scene_hash;  // LoadedScene::hash
  FilmSettings film;
  RenderSettings render;
};

// In what the samples of two films differ, for a message: "the seed is 3, not 4". Samples do not
// depend on their number, nor on the exposure. Empty: they can go into one film.
[[nodiscard]] std::vector<std::string> differences(const FilmOrigin& found,
                                                   const FilmOrigin& wanted);

// All that samples depend on besides the program and the scene, in words.
[[nodiscard]] std::string describe_settings(const FilmOrigin& origin);

struct FilmFile {
  FilmOrigin origin;
  FilmSamples samples;
  Film film;
};

// With its dot.
inline constexpr const char* film_extension = ".film";

// Replaces `file` as a whole. Throws FileError, and std::invalid_argument if the film is not one of
// such settings.
void write_film(const std::filesystem::path& file, const FilmOrigin& origin,
                const FilmSamples& samples, const Film& film);

// Throws FileError if it is no such file, of another format, cut short or damaged: every change of
// a single byte is found.
[[nodiscard]] FilmFile read_film(const std::filesystem::path& file);

}  // namespace pah
