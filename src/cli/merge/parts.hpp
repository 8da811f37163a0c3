// Film files that make up one picture: by samples, by crops, or both.
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
  PixelRect rect;        // of all together
  int from = 0, to = 0;  // the samples that every pixel has
};

// In no certain order; every pixel of `rect` is in parts that have each of its samples once. Only
// one film is in memory at a time. Throws FileError, which names the parts that overlap, are
// missing, or belong to another picture.
[[nodiscard]] Parts read_parts(const std::vector<std::filesystem::path>& files);

// Throws FileError.
[[nodiscard]] Film sum_of(const Parts& parts);

// Throws FileError, which says how to render what is missing.
[[noreturn]] void fail_for_gap(int from, int to);

}  // namespace pah::cli
