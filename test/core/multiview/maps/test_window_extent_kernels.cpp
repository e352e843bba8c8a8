#include <algorithm>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/multiview/maps/window_extent_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomMap;

class WindowExtentKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, WindowExtentKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(WindowExtentKernels, WindowsEqualThePlainVersionAndMorphology)
{
  for (const int width : {1, 2, 3, 16, 33, 203})
  {
    const cv::Mat map = randomMap(7, width, -3.0F, 3.0F);
    std::vector<float> scratch(extentScratch(width));
    for (int radius = 1; radius <= ExtentRow::MAX_RADIUS; ++radius)
    {
      cv::Mat lowest;
      cv::Mat highest;
      const cv::Mat window = cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
      cv::erode(map, lowest, window);
      cv::dilate(map, highest, window);
      for (int y = 0; y < map.rows; ++y)
      {
        cv::Mat results[4];
        std::generate(std::begin(results), std::end(results), [&] { return cv::Mat(1, width, CV_32FC1); });
        ExtentRow row = extentRowOf(map, y, radius);
        row.columns = scratch.data();
        row.low = results[0].ptr<float>();
        row.high = results[1].ptr<float>();
        findExtents(row);
        row.low = results[2].ptr<float>();
        row.high = results[3].ptr<float>();
        findExtentsPlain(row);
        EXPECT_EQ(cv::norm(results[0], results[2], cv::NORM_INF), 0.0);
        EXPECT_EQ(cv::norm(results[1], results[3], cv::NORM_INF), 0.0);
        EXPECT_EQ(cv::norm(results[0], lowest.row(y), cv::NORM_INF), 0.0) << width << ", row " << y;
        EXPECT_EQ(cv::norm(results[1], highest.row(y), cv::NORM_INF), 0.0) << width << ", row " << y;
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
