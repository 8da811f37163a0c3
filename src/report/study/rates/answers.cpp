#include "report/study/rates/answers.hpp"

#include <algorithm>
#include <cmath>

namespace pah {
namespace {

bool differ(const Hit& a, const Hit& b) {
  if (a.triangle == b.triangle) return false;
  if (a.valid() != b.valid()) return true;
  return std::abs(a.t - b.t) > tie * std::max(std::abs(a.t), std::abs(b.t));
}

}  // namespace

void Answers::reserve(RayQuery query, std::size_t rays) {
  if (query == RayQuery::nearest) {
    if (hits.size() < rays) hits.resize(rays);
  } else if (occluded.size() < rays) {
    occluded.resize(rays);
  }
}

void ask(const Accelerator& accelerator, RayQuery query, std::span<const Ray> rays,
         Answers& answers, std::size_t first, TraversalCounts* counts) {
  if (query == RayQuery::nearest) {
    accelerator.closest_hit(rays, std::span(answers.hits).subspan(first, rays.size()), counts);
  } else {
    accelerator.occluded(rays, std::span(answers.occluded).subspan(first, rays.size()), counts);
  }
}

Answers ask_all(const Accelerator& accelerator, RayQuery query, const RayBatches& batches,
                TraversalCounts* counts) {
  Answers answers;
  answers.reserve(query, batches.rays.size());
  for (std::size_t i = 0; i < batches.ends.size(); ++i)
    ask(accelerator, query, batches.batch(i), answers, batches.first_of(i), counts);
  return answers;
}

std::uint64_t count_mismatches(RayQuery query, const Answers& a, const Answers& b) {
  std::uint64_t count = 0;
  if (query == RayQuery::nearest) {
    for (std::size_t i = 0; i < a.hits.size(); ++i) count += differ(a.hits[i], b.hits[i]) ? 1 : 0;
  } else {
    for (std::size_t i = 0; i < a.occluded.size(); ++i)
      count += a.occluded[i] != b.occluded[i] ? 1 : 0;
  }
  return count;
}

}  // namespace pah
