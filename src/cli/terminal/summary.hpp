// The last line that a render prints.
#pragma once

#include <filesystem>
#include <pah/render/render.hpp>
#include <string>

namespace pah::cli {

// Returns "64", or "12.4 of 64" if some are missing.
[[nodiscard]] std::string format_samples(const RenderResult& result, int wanted);

// Returns "error about 2.1 % (256 samples would halve it)"; empty with fewer than two samples per
// pixel.
[[nodiscard]] std::string format_error(const RenderResult& result);

// `seconds` is the time of the whole program; the rate of rays uses the time of the render alone.
[[nodiscard]] std::string summary_of(const std::filesystem::path& file, const RenderResult& result,
                                     int samples_wanted, double seconds);

}  // namespace pah::cli
