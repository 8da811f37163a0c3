// Renders the reference pictures again: all, or those named on the command line.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "../reference.hpp"

namespace {

using namespace pah;

// Of the mean, where the picture is not black; 0 for a black picture.
double median_relative_error(const golden::Batches& batches) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < batches.mean().size(); ++i) {
    const double mean = batches.mean()[i].y;
    if (mean > 0) errors.push_back(std::sqrt(batches.variance(i).y / batches.count()) / mean);
  }
  if (errors.empty()) return 0;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

void regenerate(const std::string& name) {
  const auto begin = std::chrono::steady_clock::now();
  const LoadedScene scene = golden::load_golden(name);
  const golden::Batches batches =
      golden::render_batches(scene.scene, golden::reference_seed, golden::reference_batches);
  golden::write_reference(name, scene, batches);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  fmt::print("{:16} {:5} samples per pixel, {:6.1f} s, median relative error {:.2g}\n", name,
             batches.count() * scene.scene.render.samples, seconds.count(),
             median_relative_error(batches));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) names.assign(golden::scene_names.begin(), golden::scene_names.end());
    for (const std::string& name : names) regenerate(name);
  } catch (const SceneError& error) {
    for (const LocatedError& e : error.errors()) fmt::print(stderr, "{}\n", format_error(e));
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
