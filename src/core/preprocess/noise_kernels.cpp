// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/preprocess/noise_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/vector_loops-inl.h"
#include "core/preprocess/noise_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// a - 2 * b + c.
template <class Words>
HWY_INLINE hn::Vec<Words> bend(Words /*words*/, hn::Vec<Words> a, hn::Vec<Words> b, hn::Vec<Words> c)
{
  return hn::Sub(hn::Add(a, c), hn::Add(b, b));
}

void sumMaskResponsesSimd(const cv::Mat& image, int top, int bottom, std::uint16_t* response,
                          std::uint16_t* level)
{
  const int channels = image.channels();
  const std::uint8_t* const first_row = image.ptr<std::uint8_t>(top - 1);
  const auto stride = static_cast<std::ptrdiff_t>(image.step[0]);
  forElements<std::int16_t>(0, (image.cols - 2) * channels,
                            [&](auto words, int i) HWY_ATTR
                            {
                              const hn::RebindToUnsigned<decltype(words)> positive;
                              const hn::Rebind<std::uint8_t, decltype(words)> bytes;
                              const int x = i + channels;
                              const std::uint8_t* row = first_row + x;
                              const auto at = [&](int shift) HWY_ATTR
                              { return hn::PromoteTo(words, hn::LoadU(bytes, row + shift)); };
                              const auto bend_of_row = [&]() HWY_ATTR
                              { return bend(words, at(-channels), at(0), at(channels)); };
                              auto above = bend_of_row();
                              row += stride;
                              auto middle = bend_of_row();
                              auto sum = hn::Zero(words);
                              auto brightness = hn::Zero(words);
                              for (int y = top; y < bottom; ++y)
                              {
                                brightness = hn::Add(brightness, at(0));
                                row += stride;
                                const auto below = bend_of_row();
                                sum = hn::Add(sum, hn::Abs(bend(words, above, middle, below)));
                                above = middle;
                                middle = below;
                              }
                              hn::StoreU(hn::BitCast(positive, sum), positive, response + x);
                              hn::StoreU(hn::BitCast(positive, brightness), positive, level + x);
                            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth
{
HWY_EXPORT(sumMaskResponsesSimd);

void sumMaskResponses(const cv::Mat& image, int top, int bottom, std::uint16_t* response,
                      std::uint16_t* level)
{
  HWY_DYNAMIC_DISPATCH(sumMaskResponsesSimd)(image, top, bottom, response, level);
}

}  // namespace light_field_depth
#endif  // HWY_ONCE
