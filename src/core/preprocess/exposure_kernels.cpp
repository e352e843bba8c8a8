// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/preprocess/exposure_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/vector_loops-inl.h"
#include "core/preprocess/exposure_kernels.h"

#ifndef LIGHT_FIELD_DEPTH_CORE_EXPOSURE_KERNELS_BORDER
#define LIGHT_FIELD_DEPTH_CORE_EXPOSURE_KERNELS_BORDER
namespace light_field_depth
{
/// Pixels that the memory of a row has on both sides.
constexpr int ROW_BORDER_PX = 4;

/// Fills `radius` pixels on both sides of a row.
template <class Element>
void mirrorEnds(Element* row, int width, int channels, int radius)
{
  for (int x = 1; x <= radius; ++x)
  {
    for (int channel = 0; channel < channels; ++channel)
    {
      row[-x * channels + channel] = row[x * channels + channel];
      row[(width - 1 + x) * channels + channel] = row[(width - 1 - x) * channels + channel];
    }
  }
}
}  // namespace light_field_depth
#endif

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

template <class Words>
HWY_INLINE hn::Vec<Words> loadBytes(Words words, const std::uint8_t* from)
{
  return hn::PromoteTo(words, hn::LoadU(hn::Rebind<std::uint8_t, Words>(), from));
}

template <class Words>
HWY_INLINE void storeBytes(Words /*words*/, hn::Vec<Words> values, std::uint8_t* to)
{
  const hn::RebindToSigned<Words> demotable;
  const hn::Rebind<std::uint8_t, Words> bytes;
  hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(demotable, values)), bytes, to);
}

/// outer + 4 * inner + 6 * middle.
template <class Words>
HWY_INLINE hn::Vec<Words> weigh(Words words, hn::Vec<Words> outer, hn::Vec<Words> inner,
                                hn::Vec<Words> middle)
{
  const auto four = hn::ShiftLeft<2>(hn::Add(inner, middle));
  return hn::Add(hn::Add(outer, four), hn::Mul(middle, hn::Set(words, std::uint16_t{2})));
}

void smoothRowSimd(const RowsAbout<std::uint8_t, 5>& rows, int width, int channels, std::uint16_t* memory,
                   std::uint8_t* smooth)
{
  std::uint16_t* const columns = memory + ROW_BORDER_PX * channels;
  const int count = width * channels;
  forElements<std::uint16_t>(
      0, count,
      [&](auto words, int x) HWY_ATTR
      {
        const auto at = [&](std::size_t row) HWY_ATTR { return loadBytes(words, rows[row] + x); };
        hn::StoreU(weigh(words, hn::Add(at(0), at(4)), hn::Add(at(1), at(3)), at(2)), words, columns + x);
      });
  mirrorEnds(columns, width, channels, 2);
  forElements<std::uint16_t>(
      0, count,
      [&](auto words, int x) HWY_ATTR
      {
        const auto at = [&](int column) HWY_ATTR
        { return hn::LoadU(words, columns + x + column * channels); };
        const auto sum = weigh(words, hn::Add(at(-2), at(2)), hn::Add(at(-1), at(1)), at(0));
        storeBytes(words, hn::ShiftRight<8>(hn::Add(sum, hn::Set(words, std::uint16_t{128}))), smooth + x);
      });
}

void cutOffRowSimd(const RowsAbout<std::uint8_t, 3>& rows, int width, int channels, std::uint8_t darkest,
                   std::uint8_t brightest, std::uint16_t* memory, std::uint8_t* cut_off)
{
  auto* const columns = reinterpret_cast<std::uint8_t*>(memory) + ROW_BORDER_PX * channels;
  const int count = width * channels;
  // Not 0 where a value of the column is out of bounds.
  forElements<std::uint8_t>(0, count,
                            [&](auto bytes, int x) HWY_ATTR
                            {
                              const auto a = hn::LoadU(bytes, rows[0] + x);
                              const auto b = hn::LoadU(bytes, rows[1] + x);
                              const auto c = hn::LoadU(bytes, rows[2] + x);
                              const auto least = hn::Min(hn::Min(a, b), c);
                              const auto most = hn::Max(hn::Max(a, b), c);
                              const auto below = hn::SaturatedSub(hn::Set(bytes, darkest), least);
                              const auto above = hn::SaturatedSub(most, hn::Set(bytes, brightest));
                              hn::StoreU(hn::Or(below, above), bytes, columns + x);
                            });
  mirrorEnds(columns, width, channels, 1);
  forElements<std::uint8_t>(0, count,
                            [&](auto bytes, int x) HWY_ATTR
                            {
                              const auto sides = hn::Or(hn::LoadU(bytes, columns + x - channels),
                                                        hn::LoadU(bytes, columns + x + channels));
                              hn::StoreU(hn::Or(hn::LoadU(bytes, columns + x), sides), bytes, cut_off + x);
                            });
}

/// The sum over nine neighbours.
template <class Tag, class Element>
HWY_INLINE hn::Vec<Tag> sumAlongRow(Tag tag, const Element* middle)
{
  auto sum = hn::LoadU(tag, middle);
  for (int i = 1; i <= ROW_BORDER_PX; ++i)
  {
    sum = hn::Add(sum, hn::Add(hn::LoadU(tag, middle - i), hn::LoadU(tag, middle + i)));
  }
  return sum;
}

/// 9 x 9 pixels.
constexpr float SHARE_OF_WINDOW = 1.0F / 81.0F;

void deviationRowSimd(const RowsAbout<std::uint8_t, 9>& rows, int width, std::uint16_t* memory,
                      float* deviation)
{
  std::uint16_t* const columns = memory + ROW_BORDER_PX;
  forElements<std::uint16_t>(0, width,
                             [&](auto words, int x) HWY_ATTR
                             {
                               auto sum = loadBytes(words, rows[0] + x);
                               for (std::size_t row = 1; row < rows.size(); ++row)
                               {
                                 sum = hn::Add(sum, loadBytes(words, rows[row] + x));
                               }
                               hn::StoreU(sum, words, columns + x);
                             });
  mirrorEnds(columns, width, 1, ROW_BORDER_PX);
  forElements<float>(
      0, width,
      [&](auto floats, int x) HWY_ATTR
      {
        const hn::Rebind<std::int32_t, decltype(floats)> integers;
        const hn::Rebind<std::uint16_t, decltype(floats)> words;
        const auto sum = hn::ConvertTo(floats, hn::PromoteTo(integers, sumAlongRow(words, columns + x)));
        const auto value = hn::ConvertTo(floats, loadBytes(integers, rows[rows.size() / 2] + x));
        const auto mean = hn::Mul(sum, hn::Set(floats, SHARE_OF_WINDOW));
        hn::StoreU(hn::Sub(value, mean), floats, deviation + x);
      });
}

void normalizeRowSimd(const RowsAbout<float, 9>& deviations, int width, const Normalization& normalization,
                      float* memory, std::uint8_t* normalized)
{
  float* const columns = memory + ROW_BORDER_PX;
  forElements<float>(0, width,
                     [&](auto floats, int x) HWY_ATTR
                     {
                       auto sum = hn::Zero(floats);
                       for (const float* row : deviations)
                       {
                         const auto value = hn::LoadU(floats, row + x);
                         sum = hn::Add(sum, hn::Mul(value, value));
                       }
                       hn::StoreU(sum, floats, columns + x);
                     });
  mirrorEnds(columns, width, 1, ROW_BORDER_PX);
  forElements<float>(
      0, width,
      [&](auto floats, int x) HWY_ATTR
      {
        const hn::Rebind<std::uint8_t, decltype(floats)> bytes;
        const auto square = hn::Mul(sumAlongRow(floats, columns + x), hn::Set(floats, SHARE_OF_WINDOW));
        const auto contrast = hn::Add(hn::Sqrt(square), hn::Set(floats, normalization.least));
        const auto value = hn::LoadU(floats, deviations[deviations.size() / 2] + x);
        const auto scaled = hn::Div(hn::Mul(value, hn::Set(floats, normalization.scale)), contrast);
        const auto shifted = hn::Add(scaled, hn::Set(floats, normalization.middle));
        hn::StoreU(hn::DemoteTo(bytes, hn::NearestInt(shifted)), bytes, normalized + x);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth
{
HWY_EXPORT(smoothRowSimd);
HWY_EXPORT(cutOffRowSimd);
HWY_EXPORT(deviationRowSimd);
HWY_EXPORT(normalizeRowSimd);

std::size_t memoryOfRow(int width, int channels)
{
  return static_cast<std::size_t>(width + 2 * ROW_BORDER_PX) * static_cast<std::size_t>(channels);
}

void smoothRow(const RowsAbout<std::uint8_t, 5>& rows, int width, int channels, std::uint16_t* memory,
               std::uint8_t* smooth)
{
  HWY_DYNAMIC_DISPATCH(smoothRowSimd)(rows, width, channels, memory, smooth);
}

void cutOffRow(const RowsAbout<std::uint8_t, 3>& rows, int width, int channels, std::uint8_t darkest,
               std::uint8_t brightest, std::uint16_t* memory, std::uint8_t* cut_off)
{
  HWY_DYNAMIC_DISPATCH(cutOffRowSimd)(rows, width, channels, darkest, brightest, memory, cut_off);
}

void deviationRow(const RowsAbout<std::uint8_t, 9>& rows, int width, std::uint16_t* memory, float* deviation)
{
  HWY_DYNAMIC_DISPATCH(deviationRowSimd)(rows, width, memory, deviation);
}

void normalizeRow(const RowsAbout<float, 9>& deviations, int width, const Normalization& normalization,
                  float* memory, std::uint8_t* normalized)
{
  HWY_DYNAMIC_DISPATCH(normalizeRowSimd)(deviations, width, normalization, memory, normalized);
}

}  // namespace light_field_depth
#endif  // HWY_ONCE
