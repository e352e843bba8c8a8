#include "core/preprocess/axis_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace light_field_depth
{
namespace
{
constexpr Displacements DISPLACEMENTS = {3.0F, 0.5F};
constexpr float NOTHING_SEEN = 1.5F;

cv::Mat randomImage(const cv::Size& size)
{
  cv::Mat image(size, CV_32FC1);
  cv::RNG random(11);
  random.fill(image, cv::RNG::NORMAL, 0.0, 1.0);
  return image;
}

/// What is seen at p - displacement in the view is at p in the image.
cv::Mat moved(const cv::Mat& image, int x, int y)
{
  cv::Mat view(image.size(), CV_32FC1);
  for (int row = 0; row < image.rows; ++row)
  {
    for (int column = 0; column < image.cols; ++column)
    {
      view.at<float>(row, column) =
          image.at<float>(std::clamp(row + y, 0, image.rows - 1), std::clamp(column + x, 0, image.cols - 1));
    }
  }
  return view;
}

int bestLabel(const cv::Mat& costs, int cell)
{
  int best = 0;
  for (int label = 1; label < costs.rows; ++label)
  {
    best = costs.at<float>(label, cell) < costs.at<float>(best, cell) ? label : best;
  }
  return best;
}

TEST(AxisSweep, DisplacementsLieAboutZero)
{
  EXPECT_EQ(DISPLACEMENTS.count(), 13);
  EXPECT_FLOAT_EQ(DISPLACEMENTS.at(0), -3.0F);
  EXPECT_FLOAT_EQ(DISPLACEMENTS.at(6), 0.0F);
  EXPECT_FLOAT_EQ(DISPLACEMENTS.at(12), 3.0F);
}

TEST(AxisSweep, TheTrueDisplacementCostsNothingAlongItsAxis)
{
  ThreadPool pool(2);
  const cv::Mat reference = randomImage({40, 32});
  for (const Axis axis : {Axis::X, Axis::Y})
  {
    const int x = axis == Axis::X ? 2 : 0;
    const int y = axis == Axis::Y ? 2 : 0;
    const std::vector<SweptView> views = {{moved(reference, x, y), 1.0F}, {moved(reference, -x, -y), -1.0F}};
    const cv::Mat costs = sweepAxis(reference, views, axis, DISPLACEMENTS, pool);
    ASSERT_EQ(costs.size(), cv::Size(20 * 16, 13));
    const int middle = 8 * 20 + 10;
    EXPECT_EQ(bestLabel(costs, middle), DISPLACEMENTS.half() + 4);
    EXPECT_NEAR(costs.at<float>(DISPLACEMENTS.half() + 4, middle), 0.0F, 1e-6F);
    // The mean of min(|a - b|, 1.5) of unrelated values of deviation 1 is 0.92.
    EXPECT_NEAR(costs.at<float>(0, middle), 0.92F, 0.25F);
  }
}

TEST(AxisSweep, WhereNoViewSeesAPixelNothingIsKnown)
{
  ThreadPool pool(1);
  const cv::Mat reference(16, 16, CV_32FC1, cv::Scalar(0.0));
  const cv::Mat costs = sweepAxis(reference, {{reference, 8.0F}}, Axis::X, {3.0F, 3.0F}, pool);
  // Displacements of -24, 0 and 24 pixels of the view: outside, inside, outside.
  EXPECT_FLOAT_EQ(costs.at<float>(0, 0), NOTHING_SEEN);
  EXPECT_FLOAT_EQ(costs.at<float>(1, 0), 0.0F);
  EXPECT_FLOAT_EQ(costs.at<float>(2, 63), NOTHING_SEEN);
}

TEST(AxisSweep, AUnitBelowOneMovesAViewByLess)
{
  ThreadPool pool(1);
  const cv::Mat reference = randomImage({40, 32});
  const std::vector<SweptView> views = {{moved(reference, 1, 0), 0.5F}};
  const cv::Mat costs = sweepAxis(reference, views, Axis::X, DISPLACEMENTS, pool);
  EXPECT_EQ(bestLabel(costs, 8 * 20 + 10), DISPLACEMENTS.half() + 4) << "2 units of half a pixel";
}

}  // namespace
}  // namespace light_field_depth
