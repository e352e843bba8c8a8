// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/search/median_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <utility>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/search/median_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr int RADIUS = MEDIAN_SIZE / 2;
constexpr std::size_t SIDE = MEDIAN_SIZE;

/// Two values that are put in order.
struct Exchange
{
  std::size_t lower;
  std::size_t upper;
};

constexpr std::array<Exchange, 9> SORT_FIVE = {
    {{0, 1}, {3, 4}, {2, 4}, {2, 3}, {1, 4}, {0, 3}, {0, 2}, {1, 3}, {1, 2}}};

/// Finds the median of 25 values, value SIDE * k + column the k-th of a sorted column: sorts the k-th values
/// of the columns, then those that can still be the median. Each exchange is needed: without it some columns
/// of zeros and ones give another median, and with all of them none does.
constexpr std::array<Exchange, 58> SELECT_MEDIAN = {
    {{0, 1},   {3, 4},   {2, 4},   {2, 3},   {1, 4},   {0, 3},   {1, 3},   {5, 6},   {8, 9},   {7, 9},
     {7, 8},   {6, 9},   {5, 8},   {6, 8},   {6, 7},   {10, 11}, {13, 14}, {12, 14}, {12, 13}, {11, 14},
     {10, 13}, {10, 12}, {11, 13}, {15, 16}, {18, 19}, {17, 18}, {16, 19}, {15, 18}, {15, 17}, {16, 18},
     {16, 17}, {20, 21}, {23, 24}, {22, 24}, {22, 23}, {20, 23}, {20, 22}, {21, 22}, {15, 3},  {7, 4},
     {8, 17},  {16, 8},  {12, 11}, {13, 9},  {3, 7},   {21, 8},  {13, 11}, {7, 16},  {4, 21},  {11, 20},
     {4, 16},  {13, 11}, {16, 12}, {21, 13}, {8, 11},  {4, 21},  {8, 12},  {21, 8}}};
constexpr std::size_t MEDIAN_AT = 8;  // where the exchanges leave it

template <class V>
HWY_INLINE void exchange(V& lower, V& upper)
{
  const V least = hn::Min(lower, upper);
  upper = hn::Max(lower, upper);
  lower = least;
}

/// Unrolled, so that the values stay in registers and what nobody asks for is not computed.
template <const auto& EXCHANGES, class V, std::size_t... I>
HWY_INLINE void exchangeAll(V* values, std::index_sequence<I...> /*all*/)
{
  (exchange(values[EXCHANGES[I].lower], values[EXCHANGES[I].upper]), ...);
}

template <const auto& EXCHANGES, class V>
HWY_INLINE void exchangeAll(V* values)
{
  exchangeAll<EXCHANGES>(values, std::make_index_sequence<EXCHANGES.size()>());
}

/// The columns x .. x + SIDE - 1 of the sorted ones.
template <class D, std::size_t... I>
HWY_INLINE void loadWindow(D f, const float* columns, std::size_t stride, hn::Vec<D>* window,
                           std::index_sequence<I...> /*all*/)
{
  ((window[I] = hn::LoadU(f, columns + I / SIDE * stride + I % SIDE)), ...);
}

void medianRowSimd(const MedianRow& row)
{
  const int width = row.width;
  const std::size_t stride = static_cast<std::size_t>(width) + 2 * RADIUS;
  forPixels(0, width,
            [&](auto f, int x)
            {
              hn::Vec<decltype(f)> column[SIDE];
              for (std::size_t i = 0; i < SIDE; ++i)
              {
                column[i] = hn::LoadU(f, row.rows[i] + x);
              }
              exchangeAll<SORT_FIVE>(column);
              for (std::size_t i = 0; i < SIDE; ++i)
              {
                hn::StoreU(column[i], f, row.sorted_columns + i * stride + RADIUS + x);
              }
            });
  for (std::size_t i = 0; i < SIDE; ++i)
  {
    float* const first = row.sorted_columns + i * stride + RADIUS;
    for (int dx = 1; dx <= RADIUS; ++dx)
    {
      first[-dx] = first[0];
      first[width - 1 + dx] = first[width - 1];
    }
  }
  forPixels(0, width,
            [&](auto f, int x)
            {
              hn::Vec<decltype(f)> window[SIDE * SIDE];
              loadWindow(f, row.sorted_columns + x, stride, window, std::make_index_sequence<SIDE * SIDE>());
              exchangeAll<SELECT_MEDIAN>(window);
              const auto scaled = hn::Mul(window[MEDIAN_AT], hn::Set(f, row.scale));
              hn::StoreU(hn::Add(scaled, hn::Set(f, row.offset)), f, row.medians + x);
            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(medianRowSimd);

void medianRow(const MedianRow& row)
{
  HWY_DYNAMIC_DISPATCH(medianRowSimd)(row);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
