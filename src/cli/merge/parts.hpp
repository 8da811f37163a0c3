// Film files that together make one picture: split by samples, by crops, or both.
#pragma once

#include <filesystem>
#include <pah/render/film_file.hpp>
#include <vector>

namespace pah::cli {

struct Part {
  std::filesystem::path file;
  FilmOrigin origin;
  FilmSamples samples;
};

struct Parts {
  std::vector<Part> parts;
  PixelRect rect;        // around the pixels of all parts
  int from = 0, to = 0;  // the samples that every pixel has
};

// Reads and checks parts, in any order: together they must hold each sample of each pixel of `rect`
// exactly once. Only one film is in memory at a time. Throws FileError, which names parts that
// overlap, that are missing, or that belong to another picture.
[[nodiscard]] Parts read_parts(const std::vector<std::filesystem::path>& files);

// Adds the films of the parts. Throws FileError.
[[nodiscard]] Film sum_of(const Parts& parts);

// Throws FileError, which says how to render the missing samples.
[[noreturn]] void fail_for_gap(int from, int to);

}  // namespace pah::cli
