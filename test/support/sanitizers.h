#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_SANITIZERS_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_SANITIZERS_H

namespace light_field_depth::testing
{
/// Whether the address or the thread sanitizer is in the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool IS_SANITIZED = true;
#else
inline constexpr bool IS_SANITIZED = false;
#endif

/// They map terabytes, and end the program when they get no more.
inline constexpr bool CAN_LIMIT_ADDRESS_SPACE = !IS_SANITIZED;

/// Factor on times that are waited for: the thread sanitizer makes programs 5 to 15 times as slow.
inline constexpr int SLOWNESS = IS_SANITIZED ? 10 : 1;

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_SANITIZERS_H
