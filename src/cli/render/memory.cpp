#include "cli/render/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <pah/render/film.hpp>
#include <stdexcept>
#include <string>

namespace pah::cli {
namespace {

// Returns bytes; practically infinite if the system does not tell.
double available_memory() {
  double available = std::numeric_limits<double>::infinity();
  std::ifstream memory("/proc/meminfo");
  std::string key, unit;
  for (double kibibytes = 0; memory >> key >> kibibytes; std::getline(memory, unit))
    if (key == "MemAvailable:") available = 1024 * kibibytes;
  rlimit limit{};
  double pages = 0;
  std::ifstream own("/proc/self/statm");
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && own >> pages)
    available = std::min(available, static_cast<double>(limit.rlim_cur) -
                                        pages * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  return std::max(available, 0.0);
}

}  // namespace

void check_memory_for(const FilmSettings& film) {
  const double width = film.crop ? film.crop->width() : film.width;
  const double height = film.crop ? film.crop->height() : film.height;
  const double needed = width * height * static_cast<double>(bytes_per_pixel(film));
  const double available = available_memory();
  if (needed <= available) return;
  constexpr double gigabyte = 1e9;
  throw std::runtime_error(fmt::format(
      "a film of {} x {} pixels takes {:.1f} GB of memory, and {:.1f} GB are available; "
      "render it in parts with --crop",
      width, height, needed / gigabyte, available / gigabyte));
}

}  // namespace pah::cli
