#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "core/light_field/view_mask.h"
#include "light_field_depth/core/registration.h"

namespace light_field_depth
{
namespace
{
/// Where the result at p is seen in the image.
cv::Matx23d placeSeen(const cv::Size& size, const ViewMisfit& misfit)
{
  const double middle_x = 0.5 * (size.width - 1);
  const double middle_y = 0.5 * (size.height - 1);
  const double a = 1.0 + misfit.zoom;
  const double r = misfit.roll;
  return {a, -r, misfit.shift_px.x + middle_x - a * middle_x + r * middle_y,  //
          r, a,  misfit.shift_px.y + middle_y - a * middle_y - r * middle_x};
}

cv::Mat resampled(const cv::Mat& image, const ViewMisfit& misfit)
{
  cv::Mat result;
  cv::warpAffine(image, result, placeSeen(image.size(), misfit), image.size(),
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return result;
}

bool isOff(const ViewMisfit& misfit)
{
  return misfit.shift_px != cv::Point2d() || misfit.roll != 0.0 || misfit.zoom != 0.0;
}

/// Known is what only known pixels were interpolated of.
cv::Mat resampledMask(const cv::Mat& mask, const ViewMisfit& misfit)
{
  constexpr int tap_radius_px = 2;
  cv::Mat masked;
  cv::warpAffine(maskedWithin(mask, tap_radius_px), masked, placeSeen(mask.size(), misfit), mask.size(),
                 cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return masked == 0;
}

}  // namespace

LightField correctRegistration(const LightField& light_field, const Registration& registration,
                               ThreadPool& pool)
{
  LightField result = light_field;
  for (View& view : result.views)
  {
    const double column_offset_px =
        registration.step_ratio * registration.row_offset_px + registration.step_offset_px;
    view.offset_px -= cv::Point2d(registration.row_offset_px * view.steps.x, column_offset_px * view.steps.y);
    view.steps.y *= registration.step_ratio;
  }
  if (registration.views.empty())
  {
    return result;
  }
  pool.parallelFor(0, static_cast<int>(result.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       View& view = result.views[i];
                       const ViewMisfit& misfit = registration.views[i];
                       if (!registration.resample)
                       {
                         view.offset_px += misfit.shift_px;
                       }
                       else if (i != result.reference_index && isOff(misfit))
                       {
                         view.mask = view.mask.empty() ? view.mask : resampledMask(view.mask, misfit);
                         view.image = resampled(view.image, misfit);
                       }
                     }
                   });
  return result;
}

LightField registeredViews(const LightField& light_field, const Registration& registration, ThreadPool& pool)
{
  LightField corrected = correctRegistration(light_field, registration, pool);
  if (registration.views.empty())
  {
    return corrected;
  }
  LightField known = corrected;
  known.views.clear();
  for (std::size_t i = 0; i < corrected.views.size(); ++i)
  {
    const ViewMisfit& misfit = registration.views[i];
    const bool is_reference = i == corrected.reference_index;
    if (is_reference || isOff(misfit))
    {
      known.reference_index = is_reference ? known.views.size() : known.reference_index;
      known.views.push_back(corrected.views[i]);
    }
  }
  return known;
}

}  // namespace light_field_depth
