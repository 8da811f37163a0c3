// Reads and writes films without loss, to continue them or to add them to others.
#pragma once

#include <filesystem>
#include <pah/base/errors.hpp>
#include <pah/render/film.hpp>
#include <pah/render/film_samples.hpp>
#include <pah/scene/settings.hpp>
#include <string>
#include <vector>

namespace pah {

// The origin of a film.
struct FilmOrigin {
  std::string version;     // of the program
  std::string scene_hash;  // LoadedScene::hash
  FilmSettings film;
  RenderSettings render;
};

// The settings in which the samples of two films differ, for a message: "the seed is 3, not 4". The
// number of samples and the exposure do not count. If the result is empty, the films can be added.
[[nodiscard]] std::vector<std::string> differences(const FilmOrigin& found,
                                                   const FilmOrigin& wanted);

// Describes all settings on which samples depend, besides the program and the scene.
[[nodiscard]] std::string describe_settings(const FilmOrigin& origin);

struct FilmFile {
  FilmOrigin origin;
  FilmSamples samples;
  Film film;
};

// The extension of film files, with its dot.
inline constexpr const char* film_extension = ".film";

// Replaces `file` atomically. Throws FileError, and std::invalid_argument if the film does not
// match the settings of its origin.
void write_film(const std::filesystem::path& file, const FilmOrigin& origin,
                const FilmSamples& samples, const Film& film);

// Reads a film file. Throws FileError if it is not a film file, has another format, is cut short or
// damaged; a checksum finds every change of a single byte.
[[nodiscard]] FilmFile read_film(const std::filesystem::path& file);

}  // namespace pah
