#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PAH_SANITIZED 1
#endif
#endif

namespace pah::test {

#ifdef PAH_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// Returns the number of samples to take: under sanitizers an eighth, which runs the same code. Only
// for tests that use the standard deviation of their samples, or that check each sample.
constexpr int fewer_if_sanitized(int count) { return sanitized ? count / 8 : count; }

}  // namespace pah::test
