// Rays a second of accelerators, on rays that a render asked.
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
  Scene settings;  // film, render, influence_areas and acceleration alone
};

struct NamedAccelerator {
  std::string name;
  std::unique_ptr<Accelerator> accelerator;
  double build_seconds = 0;
  bool counts = true;   // nodes and triangles
  bool nearest = true;  // is also asked for nearest hits
};

// For each of the scenes, by turns: bvh, local where areas are built, light with a grid for every
// light that may have one, embree where it is there, and embree16: the same asked for any hit by
// packets of 16 rays. `progress` as of run_study.
[[nodiscard]] std::vector<RateRow> measure_rates(
    const std::vector<StudyScene>& scenes, const StudyConfig& config,
    const std::function<void(double, const std::string&)>& progress = {});

// The same of given accelerators and rays. The first accelerator is the one that others' answers
// are held against.
[[nodiscard]] std::vector<RateRow> measure_rates(const std::string& scene, std::uint64_t triangles,
                                                 const RecordedRays& rays,
                                                 const std::vector<NamedAccelerator>& accelerators,
                                                 bool quick);

}  // namespace pah
