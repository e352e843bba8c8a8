#include <cmath>

#include <gtest/gtest.h>

#include "light_field_depth/core/geometry.h"

namespace light_field_depth
{
namespace
{
/// The published formula of the HCI benchmark, in its own units (mm): Z = b f W F / (d F s + b f W).
double hciDepth(double d, double b, double f, double w, double focus, double s)
{
  return b * f * w * focus / (d * focus * s + b * f * w);
}

TEST(Geometry, AgreesWithTheFormulaOfTheHciBenchmark)
{
  Calibration calibration;
  calibration.focal_length_px = 100.0 * 512 / 35.0;
  calibration.baseline_m = 0.025;
  calibration.disparity_offset_px = calibration.focal_length_px * calibration.baseline_m / 4.25;
  for (const float d : {-1.5F, -0.3F, 0.0F, 0.8F, 1.4F})
  {
    const double expected = hciDepth(d, 25.0, 100.0, 512.0, 4250.0, 35.0) / 1000.0;
    EXPECT_NEAR(depthFromDisparity(d, calibration), expected, 1e-5 * expected);
    EXPECT_NEAR(disparityFromDepth(depthFromDisparity(d, calibration), calibration), d, 1e-5);
  }
}

TEST(Geometry, HasNoDepthAtOrBeyondInfinity)
{
  Calibration calibration;
  calibration.focal_length_px = 500.0;
  calibration.baseline_m = 0.1;
  calibration.disparity_offset_px = 2.0;
  EXPECT_TRUE(std::isnan(depthFromDisparity(-2.0F, calibration)));
  EXPECT_TRUE(std::isnan(depthFromDisparity(-3.0F, calibration)));
  EXPECT_TRUE(std::isnan(depthFromDisparity(std::nanf(""), calibration)));
  EXPECT_TRUE(std::isnan(depthFromDisparity(INFINITY, calibration)));
  Calibration huge = calibration;
  huge.baseline_m = 1e300;
  EXPECT_TRUE(std::isnan(depthFromDisparity(3.0F, huge))) << "and none that single precision cannot hold";
  const cv::Mat depth = depthMap((cv::Mat_<float>(1, 2) << -2.0F, 3.0F), calibration);
  EXPECT_TRUE(std::isnan(depth.at<float>(0, 0)));
  EXPECT_FLOAT_EQ(depth.at<float>(0, 1), 10.0F);
}

}  // namespace
}  // namespace light_field_depth
