#include "cli/terminal/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cli/terminal/console.hpp"

namespace pah::cli {
namespace {

std::uint64_t total_rays(const RenderCounts& counts) {
  std::uint64_t total = 0;
  for (const std::uint64_t rays : counts.rays) total += rays;
  return total;
}

// Formats a mean with few digits: 0.012, 3.4, 56.7.
std::string format_mean(double mean) {
  return mean < 1 ? fmt::format("{:.2g}", mean) : fmt::format("{:.1f}", mean);
}

// Returns the mean samples per pixel, including those of an unfinished pass and dropped ones.
double samples_of(const RenderResult& result) {
  return std::max(mean_samples(result.film), static_cast<double>(result.samples));
}

}  // namespace

std::string format_samples(const RenderResult& result, int wanted) {
  if (result.complete) return fmt::format("{}", result.samples);
  const double mean = samples_of(result);
  return fmt::format("{} of {}",
                     mean > result.samples ? format_mean(mean) : fmt::format("{}", result.samples),
                     wanted);
}

std::string format_error(const RenderResult& result) {
  if (result.samples < 2) return "";
  const double relmse = estimate_error(result.film).relmse;
  if (!std::isfinite(relmse)) return "";
  const double percent = 100 * std::sqrt(relmse);
  if (percent < 0.01) return "error below 0.01 %";
  // The error falls with the square root of the number of samples.
  return fmt::format(
      "error about {} % ({:.0f} samples would halve it)",
      percent < 9.95 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent),
      4 * samples_of(result));
}

std::string summary_of(const std::filesystem::path& file, const RenderResult& result,
                       int samples_wanted, double seconds) {
  const PixelRect& rect = result.film.rect;
  std::string line =
      fmt::format("wrote {}: {} x {}, {} samples, {}, {}", file.string(), rect.width(),
                  rect.height(), format_samples(result, samples_wanted), format_duration(seconds),
                  format_ray_rate(total_rays(result.counts), result.seconds));
  const std::string error = format_error(result);
  if (!error.empty()) line += ", " + error;
  return line + "\n";
}

}  // namespace pah::cli
