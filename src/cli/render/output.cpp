#include "cli/render/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pah/image/clipping.hpp>
#include <pah/image/image_file.hpp>

#include "base/extension.hpp"
#include "base/output_file.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

// Ignores case, as write_image does.
bool has_image_extension(const fs::path& file) {
  return std::ranges::find(image_extensions(), lower_extension(file)) != image_extensions().end();
}

fs::path output_of(const RenderArguments& arguments) {
  const std::string named_after_scene = arguments.scene.stem().string() + ".png";
  if (arguments.output.empty()) return named_after_scene;
  if (has_image_extension(arguments.output) || is_film_file(arguments.output))
    return arguments.output;
  std::error_code ignored;
  if (!arguments.output.has_filename() || fs::is_directory(arguments.output, ignored))
    throw UsageError(fmt::format("-o {} is a directory; name a file in it: {}",
                                 arguments.output.string(),
                                 (arguments.output / named_after_scene).string()));
  throw UsageError(fmt::format("cannot tell the format of {} from its extension; available are {}",
                               arguments.output.string(), fmt::join(image_extensions(), ", ")));
}

// Throws UsageError for an option that does not fit the output's format.
void check_format(const RenderArguments& arguments, const fs::path& output) {
  const std::string extension = lower_extension(output);
  const auto require = [&](const char* option, const char* needed) {
    if (extension != needed)
      throw UsageError(
          fmt::format("{} is for {} files; the output is {}", option, needed, output.string()));
  };
  if (arguments.half) require("--half", ".exr");
  if (arguments.png_bits) require("--png-bits", ".png");
  if (arguments.sample_range) require("--samples", film_extension);
}

// Returns whether both paths lead to the same file.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

}  // namespace

fs::path checked_output(const RenderArguments& arguments) {
  const fs::path output = output_of(arguments);
  check_format(arguments, output);
  if (!arguments.stats.empty() && is_same_file(output, arguments.stats))
    throw UsageError("--output and --stats name the same file");
  if (!arguments.check) {
    check_output(output);
    if (!arguments.stats.empty()) check_can_create(arguments.stats);
  }
  return output;
}

void leave_out_layers(FilmSettings& film, const fs::path& output, Warnings& warnings) {
  if (lower_extension(output) == ".exr" || is_film_file(output)) return;
  if (film.albedo || film.normal || film.depth || film.variance)
    warnings.add(
        fmt::format("{} cannot hold the 'channels' of film; .exr files can", output.string()));
  film.albedo = film.normal = film.depth = film.variance = false;
}

PictureFormat format_of(const RenderArguments& arguments) {
  return {arguments.half, arguments.png_bits.value_or(8)};
}

void write_picture(const fs::path& file, const Film& film, int samples, double seconds,
                   const FilmOrigin& origin, const RenderArguments& arguments) {
  WriteOptions options = write_options(origin, samples, format_of(arguments));
  options.metadata.emplace_back("pahrender:seconds", fmt::format("{:.3f}", seconds));
  write_image(file, layers_of(film, origin.film), options);
}

void warn_of_faults(const RenderResult& result, double exposure, const fs::path& output,
                    Warnings& warnings) {
  if (result.counts.nan_samples > 0)
    warnings.add(fmt::format("{} samples were not finite or negative, and left out",
                             result.counts.nan_samples));
  const std::string extension = lower_extension(output);
  if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") return;  // linear
  const Clipping clipping = measure_clipping(radiance_of(result.film), exposure);
  if (clipping.share > 0.05)
    warnings.add(fmt::format(
        "{:.0f} % of the pixels are too bright for {}; --exposure {:.1f} "
        "would fit",
        100 * clipping.share, output.string(), std::floor(10 * clipping.exposure) / 10));
}

}  // namespace pah::cli
