#include "core/preprocess/exposure_views.h"

#include <cstdint>
#include <vector>

#include "core/preprocess/exposure_kernels.h"

namespace light_field_depth
{
namespace
{
/// Means of several pixels outside may have had values that were cut off.
constexpr std::uint8_t DARKEST_LEVEL = 5;
constexpr std::uint8_t BRIGHTEST_LEVEL = 240;

/// 40 levels for one standard deviation about the middle of the range: three of them fit into 8 bits.
/// Contrast of less than four levels is mostly noise. Set by hand.
constexpr Normalization LOCAL_CONTRAST = {40.0F, 4.0F, 128.0F};

/// The row y and as many above and below it. Rows outside mirror those inside about the outermost.
template <class Element, std::size_t COUNT>
RowsAbout<Element, COUNT> rowsAbout(const cv::Mat& image, int y)
{
  RowsAbout<Element, COUNT> rows;
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    const int row = y + static_cast<int>(i) - static_cast<int>(COUNT / 2);
    rows[i] = image.ptr<Element>(cv::borderInterpolate(row, image.rows, cv::BORDER_REFLECT_101));
  }
  return rows;
}

}  // namespace

cv::Mat normalizeLocally(const cv::Mat& grey)
{
  std::vector<std::uint16_t> sums(memoryOfRow(grey.cols, 1));
  std::vector<float> squares(sums.size());
  cv::Mat deviations(grey.size(), CV_32FC1);
  for (int y = 0; y < grey.rows; ++y)
  {
    deviationRow(rowsAbout<std::uint8_t, 9>(grey, y), grey.cols, sums.data(), deviations.ptr<float>(y));
  }
  cv::Mat result(grey.size(), CV_8UC1);
  for (int y = 0; y < grey.rows; ++y)
  {
    normalizeRow(rowsAbout<float, 9>(deviations, y), grey.cols, LOCAL_CONTRAST, squares.data(),
                 result.ptr<std::uint8_t>(y));
  }
  return result;
}

cv::Mat lowPass(const cv::Mat& image)
{
  std::vector<std::uint16_t> memory(memoryOfRow(image.cols, image.channels()));
  cv::Mat result(image.size(), image.type());
  for (int y = 0; y < image.rows; ++y)
  {
    smoothRow(rowsAbout<std::uint8_t, 5>(image, y), image.cols, image.channels(), memory.data(),
              result.ptr<std::uint8_t>(y));
  }
  return result;
}

cv::Mat cutOffValues(const cv::Mat& image)
{
  std::vector<std::uint16_t> memory(memoryOfRow(image.cols, image.channels()));
  cv::Mat result(image.size(), image.type());
  for (int y = 0; y < image.rows; ++y)
  {
    cutOffRow(rowsAbout<std::uint8_t, 3>(image, y), image.cols, image.channels(), DARKEST_LEVEL,
              BRIGHTEST_LEVEL, memory.data(), result.ptr<std::uint8_t>(y));
  }
  return result;
}

}  // namespace light_field_depth
