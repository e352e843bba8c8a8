#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/search/sample_rows.h"

namespace light_field_depth::multiview
{
namespace
{
/// A ramp of 4 levels a pixel to the right and 2 downwards, which Catmull-Rom weights keep.
PreparedView ramp(const cv::Point2d& steps)
{
  cv::Mat image(40, 48, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(4 * x + 2 * y);
    }
  }
  PreparedView view;
  preparePlanar(image, {}, 16, view.image);
  view.steps = steps;
  return view;
}

TEST(SampleRows, AreMovedByTheDisparityOfTheLabel)
{
  const LabelSpace labels{-1.0F, 0.25F, 9};
  for (const cv::Point2d& steps : {cv::Point2d(2.0, 0.0), cv::Point2d(0.0, -2.0), cv::Point2d(1.0, 1.0)})
  {
    const PreparedView view = ramp(steps);
    SampleRows rows;
    rows.reset(view, labels);
    for (int y = 8; y < 30; ++y)
    {
      for (int label = 0; label < labels.count; ++label)
      {
        const double disparity = labels.disparity(static_cast<float>(label));
        const std::uint8_t* const row = rows.row(label, y);
        const double x = 20.0 - disparity * steps.x;
        const double seen_y = y - disparity * steps.y;
        EXPECT_NEAR(row[20], 4.0 * x + 2.0 * seen_y, 1.0) << steps << ", label " << label << ", row " << y;
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
