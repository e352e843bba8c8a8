#include "core/light_field/view_mask.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace light_field_depth
{
namespace
{
constexpr double KNOWN = 255.0;

/// Repeats known pixels over the masked ones between and beside them.
/// @return false if the row has none
bool fillRow(const std::uint8_t* mask, int width, std::size_t pixel_bytes, std::uint8_t* pixels)
{
  const auto pixelAt = [&](int x) { return pixels + static_cast<std::size_t>(x) * pixel_bytes; };
  int last_known = -1;
  for (int x = 0; x <= width; ++x)
  {
    if (x < width && mask[x] == 0)
    {
      continue;
    }
    if (x == width && last_known < 0)
    {
      return false;
    }
    for (int hole = last_known + 1; hole < x; ++hole)
    {
      const bool from_left = x == width || (last_known >= 0 && hole - last_known <= x - hole);
      std::memcpy(pixelAt(hole), pixelAt(from_left ? last_known : x), pixel_bytes);
    }
    last_known = x;
  }
  return true;
}

/// Rows without a known pixel take the nearest row that has any.
void fillRows(const std::vector<bool>& known, cv::Mat& image)
{
  const int rows = image.rows;
  for (int y = 0; y < rows; ++y)
  {
    for (int distance = 1; !known[static_cast<std::size_t>(y)] && distance < rows; ++distance)
    {
      const int above = y - distance;
      const int below = y + distance;
      const bool take_above = above >= 0 && known[static_cast<std::size_t>(above)];
      if (take_above || (below < rows && known[static_cast<std::size_t>(below)]))
      {
        image.row(take_above ? above : below).copyTo(image.row(y));
        break;
      }
    }
  }
}

cv::Mat filled(const cv::Mat& image, const cv::Mat& mask)
{
  cv::Mat result = image.clone();
  std::vector<bool> known(static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y)
  {
    known[static_cast<std::size_t>(y)] =
        fillRow(mask.ptr<std::uint8_t>(y), image.cols, image.elemSize(), result.ptr<std::uint8_t>(y));
  }
  fillRows(known, result);
  return result;
}

bool hasMaskedPixel(const cv::Mat& mask)
{
  return !mask.empty() && cv::countNonZero(mask) < static_cast<int>(mask.total());
}

void invalidate(const cv::Mat& mask, cv::Mat& disparity, cv::Mat& confidence)
{
  if (hasMaskedPixel(mask))
  {
    const cv::Mat masked = mask == 0;
    disparity.setTo(std::numeric_limits<float>::quiet_NaN(), masked);
    confidence.setTo(0.0F, masked);
  }
}

}  // namespace

LightField withFilledMasks(const LightField& light_field, ThreadPool& pool)
{
  LightField result = light_field;
  pool.parallelFor(0, static_cast<int>(result.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       View& view = result.views[i];
                       if (hasMaskedPixel(view.mask))
                       {
                         view.image = filled(view.image, view.mask);
                       }
                     }
                   });
  return result;
}

cv::Mat halvedMask(const cv::Mat& mask)
{
  if (mask.empty())
  {
    return mask;
  }
  cv::Mat half(mask.rows / 2, mask.cols / 2, CV_8UC1);
  for (int y = 0; y < half.rows; ++y)
  {
    const auto* const above = mask.ptr<std::uint8_t>(2 * y);
    const auto* const below = mask.ptr<std::uint8_t>(2 * y + 1);
    auto* const row = half.ptr<std::uint8_t>(y);
    for (int x = 0; x < half.cols; ++x)
    {
      const bool known =
          above[2 * x] != 0 && above[2 * x + 1] != 0 && below[2 * x] != 0 && below[2 * x + 1] != 0;
      row[x] = known ? static_cast<std::uint8_t>(KNOWN) : 0;
    }
  }
  return half;
}

cv::Mat maskedWithin(const cv::Mat& mask, int radius_px)
{
  cv::Mat masked = mask == 0;
  if (radius_px > 0)
  {
    const int side = 2 * radius_px + 1;
    cv::dilate(masked, masked, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  }
  return masked;
}

void invalidateMasked(const LightField& light_field, DisparityEstimate& estimate)
{
  invalidate(light_field.reference().mask, estimate.disparity, estimate.confidence);
  invalidateMasked(light_field, estimate.view_disparities);
}

void invalidateMasked(const LightField& light_field, std::vector<ViewDisparity>& maps)
{
  for (ViewDisparity& map : maps)
  {
    const cv::Mat& mask = light_field.views[map.view_index].mask;
    invalidate(mask, map.disparity, map.confidence);
    if (!mask.empty() && !map.held.empty())
    {
      map.held.setTo(0.0F, mask == 0);
    }
  }
}

}  // namespace light_field_depth
