#include "light_field_depth/evaluation/photometric_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;

/// Mean absolute difference over the channels between a pixel of the reference and a bilinear sample of a
/// view; negative outside the view's frame.
float difference(const cv::Mat& reference, int x, int y, const cv::Mat& view, double at_x, double at_y)
{
  const double floor_x = std::floor(at_x);
  const double floor_y = std::floor(at_y);
  if (!(floor_x >= 0.0 && floor_y >= 0.0 && floor_x < view.cols - 1 && floor_y < view.rows - 1))
  {
    return -1.0F;
  }
  const int channels = view.channels();
  const auto left = static_cast<int>(floor_x);
  const auto top = static_cast<int>(floor_y);
  const auto fx = static_cast<float>(at_x - floor_x);
  const auto fy = static_cast<float>(at_y - floor_y);
  const std::uint8_t* const above = view.ptr<std::uint8_t>(top) + left * channels;
  const std::uint8_t* const below = view.ptr<std::uint8_t>(top + 1) + left * channels;
  const std::uint8_t* const expected = reference.ptr<std::uint8_t>(y) + x * channels;
  float sum = 0.0F;
  for (int c = 0; c < channels; ++c)
  {
    const float upper = above[c] * (1 - fx) + above[c + channels] * fx;
    const float lower = below[c] * (1 - fx) + below[c + channels] * fx;
    sum += std::abs(upper * (1 - fy) + lower * fy - static_cast<float>(expected[c]));
  }
  return sum / static_cast<float>(channels);
}

struct RowSums
{
  double differences = 0.0;
  std::size_t samples = 0;
  double medians = 0.0;
  std::size_t pixels = 0;
};

/// Every which pixel of a row is taken.
int stepOf(const LightField& field, std::size_t max_samples)
{
  const std::size_t samples = static_cast<std::size_t>(field.size().area()) * (field.views.size() - 1);
  const std::size_t most = std::max<std::size_t>(max_samples, 1);
  return static_cast<int>(
      std::clamp<std::size_t>((samples + most - 1) / most, 1, static_cast<std::size_t>(field.size().width)));
}

void measureRow(const LightField& field, const cv::Mat& disparity, int y, int step, cv::Mat& medians,
                RowSums& sums)
{
  // Moved from row to row by the golden section of the step, pixels lie far from each other.
  constexpr double golden_section = 0.618;
  const int shift = std::max(1, static_cast<int>(std::lround(golden_section * step)));
  std::vector<float> differences;
  for (int x = y * shift % step; x < disparity.cols; x += step)
  {
    const float d = disparity.at<float>(y, x);
    differences.clear();
    for (std::size_t i = 0; i < field.views.size() && std::isfinite(d); ++i)
    {
      const View& view = field.views[i];
      if (i == field.reference_index)
      {
        continue;
      }
      const float value =
          difference(field.reference().image, x, y, view.image, x - d * view.steps.x + view.offset_px.x,
                     y - d * view.steps.y + view.offset_px.y);
      if (value >= 0.0F)
      {
        differences.push_back(value);
        sums.differences += value;
      }
    }
    sums.samples += differences.size();
    if (!differences.empty())
    {
      const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
      std::nth_element(differences.begin(), middle, differences.end());
      medians.at<float>(y, x) = *middle;
      sums.medians += *middle;
      ++sums.pixels;
    }
  }
}

}  // namespace

PhotometricError photometricError(const LightField& light_field, const cv::Mat& disparity, ThreadPool& pool,
                                  std::size_t max_samples)
{
  if (disparity.size() != light_field.size() || disparity.type() != CV_32FC1)
  {
    throw InputError(
        "The disparity map has another size than the views, or is not of 32-bit floats; the photometric "
        "error compares a map with the light field that it was computed from.");
  }
  const LightField field = toEightBit(light_field);
  PhotometricError error;
  error.medians = cv::Mat(disparity.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  const int step = stepOf(field, max_samples);
  std::vector<RowSums> rows(static_cast<std::size_t>(disparity.rows));
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       measureRow(field, disparity, y, step, error.medians,
                                  rows[static_cast<std::size_t>(y)]);
                     }
                   });
  RowSums total;
  for (const RowSums& row : rows)
  {
    total.differences += row.differences;
    total.samples += row.samples;
    total.medians += row.medians;
    total.pixels += row.pixels;
  }
  error.mean = total.samples > 0 ? total.differences / static_cast<double>(total.samples) : 0.0;
  error.mean_of_medians = total.pixels > 0 ? total.medians / static_cast<double>(total.pixels) : 0.0;
  return error;
}

}  // namespace light_field_depth
