#pragma once
// Builds that watch themselves (tests/sanitize) are ten times as slow and reserve more addresses than may be capped.

namespace nacre::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsInstrumented = true;
#elif defined(__has_feature)
inline constexpr bool kIsInstrumented = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kIsInstrumented = false;
#endif

/// Factor on what a test allows in seconds.
inline constexpr int kPatience = kIsInstrumented ? 10 : 1;

}  // namespace nacre::test
