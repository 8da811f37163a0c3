// Measures the rays per second of accelerators, on the rays of a render.
#pragma once

#include <optional>
#include <pah/scene/world.hpp>

#include "report/study/rates/recorded_rays.hpp"
#include "report/study/study.hpp"

namespace pah {

// A scene whose accelerators are compared.
struct StudyScene {
  std::string name;
  World world;
  Scene settings;  // only film, render, influence_areas and acceleration
};

struct NamedAccelerator {
  std::string name;
  std::unique_ptr<Accelerator> accelerator;
  double build_seconds = 0;
  bool counts = true;   // nodes and triangles
  bool nearest = true;  // also trace nearest hits
};

// Measures in turns, for each scene: bvh; local if areas are built; light with a grid for every
// light that may have one; embree if it was found; and embree16, any hit in packets of 16 rays.
// `progress` is that of run_study().
[[nodiscard]] std::vector<RateRow> measure_rates(
    const std::vector<StudyScene>& scenes, const StudyConfig& config,
    const std::function<void(double, const std::string&)>& progress = {});

// Measures given accelerators on given rays. The answers of the first accelerator are the
// reference.
[[nodiscard]] std::vector<RateRow> measure_rates(const std::string& scene, std::uint64_t triangles,
                                                 const RecordedRays& rays,
                                                 const std::vector<NamedAccelerator>& accelerators,
                                                 bool quick);

}  // namespace pah
