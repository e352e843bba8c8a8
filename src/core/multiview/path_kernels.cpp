// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/path_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "light_field_depth/core/multiview/path_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void aggregateRowSimd(const PathRow& row, std::uint16_t* states)
{
  aggregateRowPlain(row, states);
}

void aggregateStepSimd(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                       std::uint16_t* minima)
{
  aggregateStepPlain(row, first, before, after, minima);
}

void selectLabelsSimd(const std::uint16_t* sums, int width, int labels, int pitch, float* best)
{
  selectLabelsPlain(sums, width, labels, pitch, best);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint16_t, 16>;
using WordBytes = hn::Rebind<std::uint8_t, Words>;
using Vector = hn::Vec<Words>;

enum class SumMode
{
  Store,
  Add
};

template <SumMode MODE>
HWY_INLINE void emit(Words words, Vector value, std::uint16_t* sums)
{
  if (MODE == SumMode::Add)
  {
    value = hn::Add(value, hn::LoadU(words, sums));
  }
  hn::StoreU(value, words, sums);
}

/// One pixel of one path. @return the minimum over the labels, in every lane
template <SumMode MODE>
HWY_INLINE Vector pathStep(Words words, const std::uint8_t* cost, const std::uint16_t* before,
                           Vector before_minimum, Vector p1, Vector p2, int pitch, std::uint16_t* after,
                           std::uint16_t* sums)
{
  const WordBytes bytes;
  const auto jump = hn::Add(before_minimum, p2);
  auto minimum = hn::Set(words, STATE_GUARD_VALUE);
  const int lanes = static_cast<int>(hn::Lanes(words));
  for (int label = 0; label < pitch; label += lanes)
  {
    const auto same = hn::LoadU(words, before + label);
    const auto below = hn::LoadU(words, before + label - 1);
    const auto above = hn::LoadU(words, before + label + 1);
    const auto neighbour = hn::SaturatedAdd(hn::Min(below, above), p1);
    const auto best = hn::Min(hn::Min(same, jump), neighbour);
    const auto data = hn::PromoteTo(words, hn::LoadU(bytes, cost + label));
    const auto value = hn::Add(data, hn::Sub(best, before_minimum));
    hn::StoreU(value, words, after + label);
    minimum = hn::Min(minimum, value);
    emit<MODE>(words, value, sums + label);
  }
  return hn::MinOfLanes(words, minimum);
}

template <SumMode MODE>
HWY_INLINE Vector firstStep(Words words, const std::uint8_t* cost, int pitch, std::uint16_t* after,
                            std::uint16_t* sums)
{
  const WordBytes bytes;
  auto minimum = hn::Set(words, STATE_GUARD_VALUE);
  const int lanes = static_cast<int>(hn::Lanes(words));
  for (int label = 0; label < pitch; label += lanes)
  {
    const auto value = hn::PromoteTo(words, hn::LoadU(bytes, cost + label));
    hn::StoreU(value, words, after + label);
    minimum = hn::Min(minimum, value);
    emit<MODE>(words, value, sums + label);
  }
  return hn::MinOfLanes(words, minimum);
}

/// One path in the middle of its row.
struct Walker
{
  std::uint16_t* before = nullptr;
  std::uint16_t* after = nullptr;
};

template <SumMode MODE>
HWY_INLINE void walkBoth(const PathRow& row, int first, int last, Walker& right, Walker& left,
                         Vector& right_minimum, Vector& left_minimum)
{
  const Words words;
  const auto pitch = static_cast<std::size_t>(row.pitch);
  const auto p1 = hn::Set(words, row.p1);
  for (int x = first; x < last; ++x)
  {
    const int mirrored = row.width - 1 - x;
    const std::size_t offset = static_cast<std::size_t>(x) * pitch;
    right_minimum = pathStep<MODE>(words, row.cost + offset, right.before, right_minimum, p1,
                                   hn::Set(words, row.p2[x]), row.pitch, right.after, row.sums + offset);
    std::swap(right.before, right.after);
    const std::size_t mirrored_offset = static_cast<std::size_t>(mirrored) * pitch;
    left_minimum = pathStep<MODE>(words, row.cost + mirrored_offset, left.before, left_minimum, p1,
                                  hn::Set(words, row.p2[mirrored + 1]), row.pitch, left.after,
                                  row.sums + mirrored_offset);
    std::swap(left.before, left.after);
  }
}

void aggregateRowSimd(const PathRow& row, std::uint16_t* states)
{
  const Words words;
  const auto pitch = static_cast<std::size_t>(row.pitch);
  const std::size_t state_stride = pitch + 2 * STATE_GUARD;
  std::uint16_t* const base = states + STATE_GUARD;
  Walker right{base, base + state_stride};
  Walker left{base + 2 * state_stride, base + 3 * state_stride};
  const std::size_t end = static_cast<std::size_t>(row.width - 1) * pitch;
  auto right_minimum = firstStep<SumMode::Store>(words, row.cost, row.pitch, right.before, row.sums);
  auto left_minimum =
      firstStep<SumMode::Store>(words, row.cost + end, row.pitch, left.before, row.sums + end);
  // Until the two meet each writes where nobody was; in the middle of an odd width one of them adds.
  const int half = row.width / 2;
  walkBoth<SumMode::Store>(row, 1, half, right, left, right_minimum, left_minimum);
  if (row.width % 2 != 0)
  {
    std::fill(row.sums + static_cast<std::size_t>(half) * pitch,
              row.sums + static_cast<std::size_t>(half + 1) * pitch, std::uint16_t{0});
  }
  walkBoth<SumMode::Add>(row, half, row.width, right, left, right_minimum, left_minimum);
}

void aggregateStepSimd(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                       std::uint16_t* minima)
{
  const Words words;
  const auto pitch = static_cast<std::size_t>(row.pitch);
  const std::size_t state_stride = pitch + 2 * STATE_GUARD;
  const auto p1 = hn::Set(words, row.p1);
  for (int x = 0; x < row.width; ++x)
  {
    const std::size_t offset = static_cast<std::size_t>(x) * pitch;
    const std::size_t state = static_cast<std::size_t>(x) * state_stride + STATE_GUARD;
    const auto minimum =
        first
            ? firstStep<SumMode::Add>(words, row.cost + offset, row.pitch, after + state, row.sums + offset)
            : pathStep<SumMode::Add>(words, row.cost + offset, before + state, hn::Set(words, minima[x]), p1,
                                     hn::Set(words, row.p2[x]), row.pitch, after + state, row.sums + offset);
    minima[x] = hn::GetLane(minimum);
  }
}

HWY_INLINE int labelOfMinimum(Words words, const std::uint16_t* sums, int labels)
{
  const int lanes = static_cast<int>(hn::Lanes(words));
  auto minimum = hn::Set(words, STATE_GUARD_VALUE);
  for (int label = 0; label < labels; label += lanes)
  {
    minimum = hn::Min(minimum, hn::LoadU(words, sums + label));
  }
  minimum = hn::MinOfLanes(words, minimum);
  for (int label = 0; label < labels; label += lanes)
  {
    const auto found = hn::FindFirstTrue(words, hn::Eq(minimum, hn::LoadU(words, sums + label)));
    if (found >= 0)
    {
      return label + static_cast<int>(found);
    }
  }
  return 0;
}

void selectLabelsSimd(const std::uint16_t* sums, int width, int labels, int pitch, float* best)
{
  const Words words;
  for (int x = 0; x < width; ++x)
  {
    const std::uint16_t* const pixel = sums + static_cast<std::size_t>(x) * static_cast<std::size_t>(pitch);
    const int label = std::min(labelOfMinimum(words, pixel, labels), labels - 1);
    float shift = 0.0F;
    if (label > 0 && label + 1 < labels)
    {
      const int below = pixel[label - 1] - pixel[label];
      const int above = pixel[label + 1] - pixel[label];
      const int steeper = std::max(below, above);
      shift = steeper > 0 ? 0.5F * static_cast<float>(below - above) / static_cast<float>(steeper) : 0.0F;
    }
    best[x] = static_cast<float>(label) + shift;
  }
}

#endif  // HWY_TARGET == HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(aggregateRowSimd);
HWY_EXPORT(aggregateStepSimd);
HWY_EXPORT(selectLabelsSimd);

void aggregateRow(const PathRow& row, std::uint16_t* states)
{
  HWY_DYNAMIC_DISPATCH(aggregateRowSimd)(row, states);
}

void aggregateStep(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                   std::uint16_t* minima)
{
  HWY_DYNAMIC_DISPATCH(aggregateStepSimd)(row, first, before, after, minima);
}

void selectLabels(const std::uint16_t* sums, int width, int labels, int pitch, float* best)
{
  HWY_DYNAMIC_DISPATCH(selectLabelsSimd)(sums, width, labels, pitch, best);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
