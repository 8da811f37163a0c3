// Compares Embree's packets with its single rays.

#include <numeric>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

TEST_CASE("Embree's packets answer like its single rays") {
  if (!has_embree()) {
    WARN("skipped: this was built without Embree");
    return;
  }
  const Soup soup = random_soup(500, 0.1F, Vec3{0}, 1);
  Random random(2);
  const Aabb around{Vec3{-1}, Vec3{1}};
  std::vector<Ray> rays(1003);  // the last packet is not full
  for (Ray& ray : rays) ray = {random.in_box(around), random.uniform(0, 2), random.in_box(around)};

  const auto answers = [&](EmbreeRays how) {
    std::vector<std::uint8_t> occluded(rays.size(), 2);
    make_embree(soup.triangles(), EmbreeQuality::high, how)->occluded(rays, occluded);
    return occluded;
  };
  const std::vector<std::uint8_t> single = answers(EmbreeRays::single);
  const int hits = std::accumulate(single.begin(), single.end(), 0);
  CHECK(hits > 50);
  CHECK(hits < 900);
  CHECK(answers(EmbreeRays::packets_of_8) == single);
  CHECK(answers(EmbreeRays::packets_of_16) == single);
}
