// Scenes with the rays that they are asked and the accelerators that answer them.
#pragma once

#include <map>
#include <memory>

#include "rays/recorded_rays.hpp"

namespace pah::bench {

struct BuiltAccelerator {
  std::unique_ptr<Accelerator> accelerator;
  double build_seconds = 0;  // by the clock, on all threads
};

class Subject {
 public:
  explicit Subject(const std::string& mesh) : scene_(mesh), rays_(record_rays(scene_)) {}

  [[nodiscard]] const MeshScene& scene() const { return scene_; }
  [[nodiscard]] const RecordedRays& rays() const { return rays_; }

  // `bvh`, `light_grid` or another of the names in subjects.cpp. Built when first asked for.
  [[nodiscard]] const BuiltAccelerator& built(const std::string& accelerator);

 private:
  MeshScene scene_;
  RecordedRays rays_;
  std::map<std::string, BuiltAccelerator> built_;
};

// Made when first asked for, then kept until another needs the memory.
[[nodiscard]] Subject& subject(const std::string& mesh);

}  // namespace pah::bench
