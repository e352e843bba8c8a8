#include "core/light_field/half_resolution.h"

#include <cstdint>

#include "core/light_field/half_resolution_kernels.h"
#include "core/light_field/view_mask.h"

namespace light_field_depth::multiview
{
namespace
{
/// Views of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int VIEWS_PER_CHUNK = 1;

void halveInGrey(const cv::Mat& image, cv::Mat& half)
{
  half.create(image.rows / 2, image.cols / 2, CV_8UC1);
  for (int y = 0; y < half.rows; ++y)
  {
    halveRow(image.ptr<std::uint8_t>(2 * y), image.ptr<std::uint8_t>(2 * y + 1), image.channels(), half.cols,
             half.ptr<std::uint8_t>(y));
  }
}

}  // namespace

void halveChannels(const cv::Mat& image, cv::Mat& half)
{
  half.create(image.rows / 2, image.cols / 2, image.type());
  for (int y = 0; y < half.rows; ++y)
  {
    halveChannelsRow(image.ptr<std::uint8_t>(2 * y), image.ptr<std::uint8_t>(2 * y + 1), image.channels(),
                     half.cols, half.ptr<std::uint8_t>(y));
  }
}

const LightField& HalfResolution::reduce(const LightField& light_field, ThreadPool& pool)
{
  return reduceWith(halveInGrey, light_field, pool);
}

const LightField& HalfResolution::reduceInColour(const LightField& light_field, ThreadPool& pool)
{
  return reduceWith(halveChannels, light_field, pool);
}

const LightField& HalfResolution::reduceWith(HalveImage halve_image, const LightField& light_field,
                                             ThreadPool& pool)
{
  half_.reference_index = light_field.reference_index;
  half_.views.resize(light_field.views.size());
  pool.parallelFor(0, static_cast<int>(light_field.views.size()), VIEWS_PER_CHUNK,
                   [&, halve_image](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       const View& view = light_field.views[static_cast<std::size_t>(i)];
                       View& half = half_.views[static_cast<std::size_t>(i)];
                       half.grid = view.grid;
                       half.steps = 0.5 * view.steps;
                       half.offset_px = 0.5 * view.offset_px;
                       halve_image(view.image, half.image);
                       half.mask = halvedMask(view.mask);
                     }
                   });
  return half_;
}

}  // namespace light_field_depth::multiview
