// The file that a render writes: its name, its format and the layers that it can hold.
#pragma once

#include <filesystem>
#include <pah/render/film_file.hpp>
#include <pah/render/render.hpp>

#include "cli/merge/film_picture.hpp"
#include "cli/render/render_command.hpp"
#include "cli/terminal/warnings.hpp"

namespace pah::cli {

// Returns the output that the arguments name, or the scene's name with .png. Throws UsageError if
// its format is unknown, if an option does not fit the format, or if --stats names the same file.
// Throws FileError if the files cannot be written, unless the arguments only ask to check.
[[nodiscard]] std::filesystem::path checked_output(const RenderArguments& arguments);

// Switches off the layers that the output's format cannot hold, with a warning.
void leave_out_layers(FilmSettings& film, const std::filesystem::path& output, Warnings& warnings);

[[nodiscard]] PictureFormat format_of(const RenderArguments& arguments);

// `samples` is the number that every pixel has finished, `seconds` the time of rendering.
void write_picture(const std::filesystem::path& file, const Film& film, int samples, double seconds,
                   const FilmOrigin& origin, const RenderArguments& arguments);

// Warns if samples were not finite, and if a large part of the picture is clipped.
void warn_of_faults(const RenderResult& result, double exposure,
                    const std::filesystem::path& output, Warnings& warnings);

}  // namespace pah::cli
