// What there is to measure. Each function registers the benchmarks of one file, whose names begin
// with the file's.
#pragma once

#include <string>
#include <vector>

namespace pah::bench {

void register_rays(const std::vector<std::string>& meshes);
void register_growth();
void register_builds(const std::vector<std::string>& meshes);
void register_sampler();
void register_bsdfs();
void register_lights();
void register_renders();
void register_top_levels();

}  // namespace pah::bench
