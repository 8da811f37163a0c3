#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PAH_SANITIZED 1
#endif
#endif

namespace pah::test {

// How many samples to take: under sanitizers an eighth, which goes the same ways through the code.
// Only for what is judged by its own standard deviation, or holds for each sample.
constexpr int fewer_if_sanitized(int count) {
#ifdef PAH_SANITIZED
  return count / 8;
#else
  return count;
#endif
}

}  // namespace pah::test
