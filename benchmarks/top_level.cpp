// Areas found a second, of rays without a bundle: by the list and by octrees.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <pah/influence/influence_area.hpp>
#include <random>

#include "accel/local/top_level.hpp"
#include "registrations.hpp"

namespace pah::bench {
namespace {

struct Subject {
  std::vector<Region> regions;
  std::vector<std::uint32_t> order;
  std::vector<Vec3> points;
};

// Frusta and boxes of all directions in a cube, which together hold its points some three times
// over, whatever their number; a tenth of the points is outside of the cube.
Subject make_subject(std::size_t count) {
  std::mt19937 engine(static_cast<std::uint32_t>(count));
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) * 0x1p-32;
  };
  const auto point = [&](double reach) {
    return DVec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
  };
  Subject subject;
  const double size = 3 / std::cbrt(static_cast<double>(count));
  while (subject.regions.size() < count) {
    const DVec3 direction = point(1);
    if (subject.regions.size() % 2 == 0)
      subject.regions.push_back(region_of(make_plane_area(
          point(1) - 0.5 * size * glm::normalize(direction), direction, DVec2(size), size)));
    else
      subject.regions.push_back(
          region_of(make_point_area(point(1), direction, DVec2(1.2), 0, size)));
  }
  subject.order.resize(count);
  std::iota(subject.order.begin(), subject.order.end(), 0U);
  for (int i = 0; i < 4096; ++i) subject.points.emplace_back(point(1.035));
  return subject;
}

template <typename Structure>
void measure(benchmark::State& state, const Subject& subject, const Structure& structure) {
  std::size_t asked = 0, holding = 0;
  for (auto _ : state) {
    asked = holding = 0;
    for (const Vec3& point : subject.points)
      structure.visit(point, [&](const AreaCandidate& candidate) {
        ++asked;
        if (candidate.certain || contains(subject.regions[candidate.area], point)) ++holding;
        return false;
      });
    benchmark::DoNotOptimize(holding);
  }
  const auto points = static_cast<double>(subject.points.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(subject.points.size()));
  state.counters["asked_per_point"] = static_cast<double>(asked) / points;
  state.counters["holding_per_point"] = static_cast<double>(holding) / points;
  state.counters["bytes"] = static_cast<double>(structure.memory_bytes());
}

void add(std::size_t areas) {
  const std::string number = std::to_string(areas);
  const auto subject = std::make_shared<const Subject>(make_subject(areas));
  benchmark::RegisterBenchmark(("top_level/list/" + number).c_str(), [=](benchmark::State& state) {
    measure(state, *subject, AreaList(subject->regions, subject->order));
  });
  for (const int depth : {0, 3, 4, 5, 6, 7})
    benchmark::RegisterBenchmark(
        ("top_level/octree" + (depth == 0 ? "" : "_" + std::to_string(depth)) + "/" + number)
            .c_str(),
        [=](benchmark::State& state) {
          const AreaOctree octree(subject->regions, subject->order, depth);
          measure(state, *subject, octree);
          state.counters["depth"] = octree.depth();
        });
}

}  // namespace

void register_top_levels() {
  for (const std::size_t areas : {1, 4, 8, 16, 64, 256}) add(areas);
}

}  // namespace pah::bench
