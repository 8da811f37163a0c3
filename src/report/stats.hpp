// What --stats writes: the contract for tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <pah/accel/accelerator.hpp>
#include <pah/render/render.hpp>
#include <string>

namespace pah {

struct RenderReport {
  std::string version;
  std::string scene;  // as it was named
  int width = 0, height = 0;
  int samples = 0;  // per pixel, finished by every pixel
  int threads = 0;
  std::uint64_t seed = 0;
  std::string accelerator;
  std::uint64_t triangles = 0;
  struct {
    double load = 0, build = 0, render = 0, total = 0;
  } seconds;
  RenderCounts counts;
  std::uint64_t scene_bytes = 0, film_bytes = 0;
  AcceleratorMemory accelerator_bytes;
  ErrorEstimate error;
};

// The most memory that this process has held, in bytes.
[[nodiscard]] std::uint64_t peak_memory_bytes();

[[nodiscard]] std::string stats_json(const RenderReport& report);

}  // namespace pah
