// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/preprocess/view_noise_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/preprocess/view_noise_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
DifferenceSums sumDifferencesSimd(const BlockPair& pair, int bytes)
{
  return sumDifferencesPlain(pair, bytes);
}

std::int32_t sumSlopesSimd(const BlockPair& pair)
{
  return sumSlopesPlain(pair);
}
#else
using Words = hn::FixedTag<std::int16_t, NOISE_BLOCK_PX>;
using Bytes = hn::Rebind<std::uint8_t, Words>;
using Integers = hn::FixedTag<std::int32_t, NOISE_BLOCK_PX / 2>;
using WordVector = hn::Vec<Words>;
using IntegerVector = hn::Vec<Integers>;

HWY_INLINE WordVector difference(const std::uint8_t* one, const std::uint8_t* other)
{
  const Words words;
  const Bytes bytes;
  return hn::Sub(hn::PromoteTo(words, hn::LoadU(bytes, one)), hn::PromoteTo(words, hn::LoadU(bytes, other)));
}

HWY_INLINE void addSquares(WordVector values, IntegerVector& low, IntegerVector& high)
{
  low = hn::ReorderWidenMulAccumulate(Integers(), values, values, low, high);
}

HWY_INLINE std::int32_t sumOf(IntegerVector low, IntegerVector high)
{
  const Integers integers;
  return hn::GetLane(hn::SumOfLanes(integers, hn::Add(low, high)));
}

DifferenceSums sumDifferencesSimd(const BlockPair& pair, int bytes)
{
  const Words words;
  const Integers integers;
  auto low = hn::Zero(integers);
  auto high = hn::Zero(integers);
  DifferenceSums sums;
  for (int x = 0; x < bytes; x += NOISE_BLOCK_PX)
  {
    auto column = hn::Zero(words);
    for (int y = 0; y < NOISE_BLOCK_PX; ++y)
    {
      const auto values =
          difference(pair.one + y * pair.one_stride + x, pair.other + y * pair.other_stride + x);
      column = hn::Add(column, values);
      addSquares(values, low, high);
    }
    HWY_ALIGN std::int16_t columns[NOISE_BLOCK_PX];
    hn::Store(column, words, columns);
    std::copy_n(columns, NOISE_BLOCK_PX, sums.columns + x);
  }
  sums.squares = sumOf(low, high);
  return sums;
}

std::int32_t sumSlopesSimd(const BlockPair& pair)
{
  const Words words;
  const Integers integers;
  const auto most = hn::Set(words, MAX_NOISE_DIFFERENCE);
  const auto at = [&](int y, int shift) HWY_ATTR
  {
    const auto values =
        difference(pair.one + y * pair.one_stride + shift, pair.other + y * pair.other_stride + shift);
    return hn::Min(hn::Max(values, hn::Neg(most)), most);
  };
  auto low = hn::Zero(integers);
  auto high = hn::Zero(integers);
  const auto addSlope = [&](WordVector before2, WordVector before, WordVector after, WordVector after2)
                            HWY_ATTR
  {
    const auto slope = hn::Sub(hn::ShiftLeft<3>(hn::Sub(after, before)), hn::Sub(after2, before2));
    addSquares(slope, low, high);
  };
  auto above2 = at(-2, 0);
  auto above = at(-1, 0);
  auto here = at(0, 0);
  auto below = at(1, 0);
  for (int y = 0; y < NOISE_BLOCK_PX; ++y)
  {
    const auto below2 = at(y + 2, 0);
    addSlope(above2, above, below, below2);
    addSlope(at(y, -2), at(y, -1), at(y, 1), at(y, 2));
    above2 = above;
    above = here;
    here = below;
    below = below2;
  }
  return sumOf(low, high);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth
{
HWY_EXPORT(sumDifferencesSimd);
HWY_EXPORT(sumSlopesSimd);

DifferenceSums sumDifferences(const BlockPair& pair, int bytes)
{
  return HWY_DYNAMIC_DISPATCH(sumDifferencesSimd)(pair, bytes);
}

std::int32_t sumSlopes(const BlockPair& pair)
{
  return HWY_DYNAMIC_DISPATCH(sumSlopesSimd)(pair);
}

}  // namespace light_field_depth
#endif  // HWY_ONCE
