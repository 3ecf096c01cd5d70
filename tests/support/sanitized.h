// Cases that are long under a sanitizer and run nothing that shorter ones don't: TEST_CASE("..." * skip(kSanitized)).
#pragma once

namespace tangent::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace tangent::testing
