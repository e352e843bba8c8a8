// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/light_field/half_resolution_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/light_field/half_resolution_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void halveRowSimd(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                  std::uint8_t* half)
{
  halveRowPlain(upper, lower, channels, width, half);
}

void halveChannelsRowSimd(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                          std::uint8_t* half)
{
  halveChannelsRowPlain(upper, lower, channels, width, half);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, 64>;
using Words = hn::Repartition<std::uint16_t, Bytes>;
using HalfBytes = hn::Half<Bytes>;

/// Sums of neighbouring bytes.
HWY_INLINE hn::Vec<Words> pairSums(hn::Vec<Bytes> values)
{
  const Words words;
  const auto pairs = hn::BitCast(words, values);
  return hn::Add(hn::And(pairs, hn::Set(words, 0xFF)), hn::ShiftRight<8>(pairs));
}

HWY_INLINE hn::Vec<Words> share(hn::Vec<Bytes> upper, hn::Vec<Bytes> lower, std::uint16_t weight)
{
  const Words words;
  const auto sum = hn::Add(pairSums(upper), pairSums(lower));
  return hn::MulHigh(hn::ShiftLeft<SUM_SHIFT>(sum), hn::Set(words, weight));
}

HWY_INLINE hn::Vec<HalfBytes> toBytes(hn::Vec<Words> values)
{
  const hn::RebindToSigned<Words> to_signed;
  return hn::DemoteTo(HalfBytes(), hn::BitCast(to_signed, values));
}

/// The rounded means of 2 x 2 bytes.
HWY_INLINE hn::Vec<HalfBytes> means(hn::Vec<Bytes> upper, hn::Vec<Bytes> lower)
{
  const auto sum = hn::Add(hn::Add(pairSums(upper), pairSums(lower)), hn::Set(Words(), 2));
  return toBytes(hn::ShiftRight<2>(sum));
}

struct Channels
{
  hn::Vec<Bytes> c0, c1, c2;
};

HWY_INLINE Channels loadChannels(const std::uint8_t* pixels)
{
  Channels channels;
  hn::LoadInterleaved3(Bytes(), pixels, channels.c0, channels.c1, channels.c2);
  return channels;
}

int halveColour(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* half)
{
  const HalfBytes half_bytes;
  const Words words;
  const int lanes = static_cast<int>(hn::Lanes(words));
  const auto rounding = hn::Set(words, 1U << (FRACTION_SHIFT - 1));
  int x = 0;
  for (; x + lanes <= width; x += lanes)
  {
    const Channels a = loadChannels(upper + static_cast<std::ptrdiff_t>(x) * 6);
    const Channels b = loadChannels(lower + static_cast<std::ptrdiff_t>(x) * 6);
    const auto sum = hn::Add(hn::Add(share(a.c0, b.c0, BLUE_SHARE), share(a.c1, b.c1, GREEN_SHARE)),
                             share(a.c2, b.c2, RED_SHARE));
    hn::StoreU(toBytes(hn::ShiftRight<FRACTION_SHIFT>(hn::Add(sum, rounding))), half_bytes, half + x);
  }
  return x;
}

int halveGrey(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* half)
{
  const Bytes bytes;
  const HalfBytes half_bytes;
  const int lanes = static_cast<int>(hn::Lanes(half_bytes));
  int x = 0;
  for (; x + lanes <= width; x += lanes)
  {
    const auto a = hn::LoadU(bytes, upper + static_cast<std::ptrdiff_t>(x) * 2);
    const auto b = hn::LoadU(bytes, lower + static_cast<std::ptrdiff_t>(x) * 2);
    hn::StoreU(means(a, b), half_bytes, half + x);
  }
  return x;
}

void halveRowSimd(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                  std::uint8_t* half)
{
  const int done =
      channels == 3 ? halveColour(upper, lower, width, half) : halveGrey(upper, lower, width, half);
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(done) * 2 * channels;
  halveRowPlain(upper + offset, lower + offset, channels, width - done, half + done);
}

/// Of each channel by itself.
int halveThreeChannels(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* half)
{
  const HalfBytes half_bytes;
  const int lanes = static_cast<int>(hn::Lanes(half_bytes));
  int x = 0;
  for (; x + lanes <= width; x += lanes)
  {
    const Channels a = loadChannels(upper + static_cast<std::ptrdiff_t>(x) * 6);
    const Channels b = loadChannels(lower + static_cast<std::ptrdiff_t>(x) * 6);
    hn::StoreInterleaved3(means(a.c0, b.c0), means(a.c1, b.c1), means(a.c2, b.c2), half_bytes,
                          half + static_cast<std::ptrdiff_t>(x) * 3);
  }
  return x;
}

void halveChannelsRowSimd(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                          std::uint8_t* half)
{
  const int done =
      channels == 3 ? halveThreeChannels(upper, lower, width, half) : halveGrey(upper, lower, width, half);
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(done) * channels;
  halveChannelsRowPlain(upper + 2 * offset, lower + 2 * offset, channels, width - done, half + offset);
}

#endif  // HWY_TARGET == HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(halveRowSimd);
HWY_EXPORT(halveChannelsRowSimd);

void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
              std::uint8_t* half)
{
  HWY_DYNAMIC_DISPATCH(halveRowSimd)(upper, lower, channels, width, half);
}

void halveChannelsRow(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                      std::uint8_t* half)
{
  HWY_DYNAMIC_DISPATCH(halveChannelsRowSimd)(upper, lower, channels, width, half);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
