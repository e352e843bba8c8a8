// Views that show nothing of the scene in places: what rectification could not fill, corners outside of a
// lens.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/light_field/view_mask.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "support/benchmark_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
/// A wedge at the left or right side: so many pixels at the top, and so many at the bottom.
struct Wedge
{
  bool left = true;
  int top_px = 0;
  int bottom_px = 0;

  bool covers(int x, int y, const cv::Size& size) const
  {
    const double share = static_cast<double>(y) / (size.height - 1);
    const double width = top_px + share * (bottom_px - top_px);
    return (left ? x : size.width - 1 - x) < width;
  }
};

/// Wedges of another width in each view, on alternating sides; black.
LightField withWedges(const LightField& light_field, int narrowest_px, int widest_px)
{
  LightField result = light_field;
  const int span = widest_px - narrowest_px + 1;
  for (std::size_t i = 0; i < result.views.size(); ++i)
  {
    View& view = result.views[i];
    const int index = static_cast<int>(i);
    const Wedge wedges[] = {{true, narrowest_px + index * 7 % span, narrowest_px + index * 5 % span},
                            {false, narrowest_px + index * 3 % span, narrowest_px + index * 11 % span}};
    view.mask = cv::Mat(view.image.size(), CV_8UC1, cv::Scalar(255));
    for (int y = 0; y < view.mask.rows; ++y)
    {
      for (int x = 0; x < view.mask.cols; ++x)
      {
        if (wedges[0].covers(x, y, view.mask.size()) || wedges[1].covers(x, y, view.mask.size()))
        {
          view.mask.at<std::uint8_t>(y, x) = 0;
        }
      }
    }
    view.image = view.image.clone();
    view.image.setTo(0, view.mask == 0);
  }
  return result;
}

/// Percentage of the known pixels in columns first..last - 1 whose error exceeds the threshold.
double badIn(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& known, int first, int last,
             double threshold_px)
{
  int bad = 0;
  int all = 0;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = first; x < last; ++x)
    {
      if (known.at<std::uint8_t>(y, x) != 0)
      {
        ++all;
        bad += std::abs(disparity.at<float>(y, x) - truth.at<float>(y, x)) <= threshold_px ? 0 : 1;
      }
    }
  }
  return 100.0 * bad / std::max(all, 1);
}

/// How many percent more of the pixels at a side may be bad than without wedges.
struct Allowed
{
  double left = 1.0;
  double right = 1.0;
};

void expectWedgesToBeHarmless(const LightField& light_field, const cv::Mat& truth, int narrowest_px,
                              int widest_px, int side_px, double threshold_px, const Allowed& allowed)
{
  Pipeline pipeline(2);
  const LightField masked = withWedges(light_field, narrowest_px, widest_px);
  const cv::Mat& known = masked.reference().mask;
  const DisparityEstimate whole = pipeline.run(light_field, {}, {}).estimate;
  const DisparityEstimate estimate = pipeline.run(masked, {}, {}).estimate;
  for (const bool left : {true, false})
  {
    SCOPED_TRACE(left ? "left" : "right");
    const int first = left ? 0 : truth.cols - side_px;
    const double without = badIn(whole.disparity, truth, known, first, first + side_px, threshold_px);
    const double with = badIn(estimate.disparity, truth, known, first, first + side_px, threshold_px);
    EXPECT_LE(with, without + (left ? allowed.left : allowed.right));
  }
  EXPECT_NEAR(estimate.range.min, whole.range.min, 0.1);
  EXPECT_NEAR(estimate.range.max, whole.range.max, 0.1);
  EXPECT_EQ(cv::countNonZero((estimate.disparity == estimate.disparity) != (known != 0)), 0)
      << "NaN where the reference is masked, and there alone";
  EXPECT_EQ(cv::countNonZero((estimate.confidence > 0) & (known == 0)), 0);
}

TEST(Masks, OfWedgesHarmNoOtherPixel)
{
  testing::SceneSettings settings;
  settings.size = {160, 96};
  settings.positions = testing::crossPositions(5, 5);
  const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
  expectWedgesToBeHarmless(scene.light_field, scene.truth, 4, 12, 24, 0.2, {1.0, 1.5});
}

TEST(Masks, OfWedgesInCottonHarmNoOtherPixel)
{
  const auto scene = testing::readBenchmarkScene("cotton");
  if (!scene)
  {
    GTEST_SKIP() << "no benchmark scenes";
  }
  expectWedgesToBeHarmless(selectViews(scene->light_field, ViewSelection::Cross), scene->truth, 10, 45, 60,
                           0.07, {1.0, 1.0});
}

TEST(Masks, AreHeldAgainstTheirImages)
{
  testing::SceneSettings settings;
  settings.positions = testing::gridPositions(1, 3);
  const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
  std::vector<View> views = scene.light_field.views;
  views[1].mask = cv::Mat(20, 20, CV_8UC1, cv::Scalar(255));
  EXPECT_THROW(makeLightField(views), InputError) << "another size";
  views[1].mask = cv::Mat(views[1].image.size(), CV_32FC1, cv::Scalar(1));
  EXPECT_THROW(makeLightField(views), InputError) << "another type";
  views[1].mask = cv::Mat::zeros(views[1].image.size(), CV_8UC1);
  EXPECT_THROW(makeLightField(views), InputError) << "nothing left of the reference";
  views[1].mask = cv::Mat();
  views[0].mask = cv::Mat::zeros(views[0].image.size(), CV_8UC1);
  EXPECT_NO_THROW(makeLightField(views)) << "another view may be masked as a whole";
}

TEST(Masks, AreFilledFromTheNearestKnownPixel)
{
  cv::Mat image(16, 16, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(16 * y + x);
    }
  }
  std::vector<View> views = {gridView(0, 0, image), gridView(0, 1, image)};
  cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(1));
  mask(cv::Rect(0, 0, 3, 16)).setTo(0);
  mask(cv::Rect(6, 0, 3, 16)).setTo(0);
  mask.row(5).setTo(0);
  views[1].mask = mask;
  ThreadPool pool(1);
  const LightField light_field = makeLightField(views);
  const LightField filled = withFilledMasks(light_field, pool);
  EXPECT_EQ(filled.views[0].image.data, image.data) << "shared";
  const cv::Mat& result = filled.views[1].image;
  const std::uint8_t expected[] = {3, 3, 3, 3, 4, 5, 5, 5, 9, 9, 10, 11, 12, 13, 14, 15};
  for (int x = 0; x < image.cols; ++x)
  {
    EXPECT_EQ(result.at<std::uint8_t>(0, x), expected[x]) << x;
    EXPECT_EQ(result.at<std::uint8_t>(5, x), 16 * 4 + expected[x]) << "the row above, " << x;
  }
}

}  // namespace
}  // namespace light_field_depth
