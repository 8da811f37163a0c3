#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

#include "generated_scenes.hpp"
#include "meshes.hpp"
#include "registrations.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  // In the head of every report: figures of different builds are not to be compared by accident.
  benchmark::AddCustomContext("pahrender_build_type", PAH_BUILD_TYPE);
  try {
    using namespace pah::bench;
    const std::vector<std::string> meshes = mesh_names();
    register_rays(meshes);
    register_rays(generated_scene_names());
    register_growth();
    register_builds(meshes);
    register_sampler();
    register_bsdfs();
    register_lights();
    register_renders();
    register_top_levels();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
