// The last line of a render.
#pragma once

#include <filesystem>
#include <pah/render/render.hpp>
#include <string>

namespace pah::cli {

// "64", or "12.4 of 64" if some were left out.
[[nodiscard]] std::string format_samples(const RenderResult& result, int wanted);

// "error about 2.1 % (256 samples would halve it)"; empty with fewer than two samples a pixel.
[[nodiscard]] std::string format_error(const RenderResult& result);

// `seconds` are those of the whole program; those of the render alone make the rate of rays.
[[nodiscard]] std::string summary_of(const std::filesystem::path& file, const RenderResult& result,
                                     int samples_wanted, double seconds);

}  // namespace pah::cli
