#include <cstddef>

#include "core/light_field/half_resolution_kernels.h"

namespace light_field_depth::multiview
{
void halveRowPlain(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                   std::uint8_t* half)
{
  if (channels == 1)
  {
    halveChannelsRowPlain(upper, lower, channels, width, half);
    return;
  }
  const auto sum_at = [&](int x, int channel)
  {
    const std::ptrdiff_t left = static_cast<std::ptrdiff_t>(x) * 2 * channels + channel;
    const std::ptrdiff_t right = left + channels;
    return static_cast<std::uint32_t>(upper[left] + upper[right] + lower[left] + lower[right]);
  };
  for (int x = 0; x < width; ++x)
  {
    const auto share = [&](int channel, std::uint32_t weight)
    { return ((sum_at(x, channel) << SUM_SHIFT) * weight) >> 16U; };
    const std::uint32_t sum = share(0, BLUE_SHARE) + share(1, GREEN_SHARE) + share(2, RED_SHARE);
    half[x] = static_cast<std::uint8_t>((sum + (1U << (FRACTION_SHIFT - 1))) >> FRACTION_SHIFT);
  }
}

void halveChannelsRowPlain(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                           std::uint8_t* half)
{
  for (int x = 0; x < width; ++x)
  {
    for (int channel = 0; channel < channels; ++channel)
    {
      const std::ptrdiff_t left = static_cast<std::ptrdiff_t>(x) * 2 * channels + channel;
      const std::ptrdiff_t right = left + channels;
      const int sum = upper[left] + upper[right] + lower[left] + lower[right];
      half[static_cast<std::ptrdiff_t>(x) * channels + channel] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
}

}  // namespace light_field_depth::multiview
