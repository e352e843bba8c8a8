#include "core/preprocess/label_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace light_field_depth
{
namespace
{
constexpr int LABELS = 40;
constexpr int PER_LEVEL = SWEEP_COST_PER_GREY_LEVEL;
const cv::Size SIZE(40, 30);

/// Costs with a valley of two grey levels for each label about the best one.
SweepCosts valleys(const cv::Mat& best_labels)
{
  SweepCosts volume;
  volume.labels = LABELS;
  volume.size = best_labels.size();
  volume.values.create(LABELS, volume.size.area(), CV_16UC1);
  for (int label = 0; label < LABELS; ++label)
  {
    for (int i = 0; i < volume.size.area(); ++i)
    {
      const float away = std::abs(static_cast<float>(label) - best_labels.ptr<float>()[i]);
      volume.cost(label)[i] = static_cast<std::uint16_t>(std::min(2.0F * away, 20.0F) * PER_LEVEL);
    }
  }
  return volume;
}

cv::Mat everywhere(float label)
{
  return {SIZE, CV_32FC1, cv::Scalar(label)};
}

TEST(LabelSupport, TheCoreHoldsAllButTheOutermostFiftieth)
{
  // Labels 10 to 19 in equal parts; one pixel in 120 has label 2, and another one label 37.
  cv::Mat labels = everywhere(0.0F);
  for (int i = 0; i < SIZE.area(); ++i)
  {
    labels.ptr<float>()[i] = static_cast<float>(10 + i % 10);
  }
  for (int i = 0; i < SIZE.area(); i += 120)
  {
    labels.ptr<float>()[i] = 2.0F;
    labels.ptr<float>()[i + 60] = 37.0F;
  }
  ThreadPool pool(2);
  const std::optional<LabelSupport> support = findSupportedLabels(valleys(labels), pool);
  ASSERT_TRUE(support);
  EXPECT_EQ(support->core.first, 10);
  EXPECT_EQ(support->core.last, 19);
  EXPECT_EQ(support->all.first, 10) << "single pixels are noise";
  EXPECT_EQ(support->all.last, 19);
}

TEST(LabelSupport, APatchOfAFewPixelsWidensTheRange)
{
  cv::Mat labels = everywhere(12.0F);
  labels(cv::Rect(20, 10, 4, 4)).setTo(30.0F);
  ThreadPool pool(2);
  const std::optional<LabelSupport> support = findSupportedLabels(valleys(labels), pool);
  ASSERT_TRUE(support);
  EXPECT_EQ(support->core.first, 12);
  EXPECT_EQ(support->core.last, 12);
  EXPECT_EQ(support->all.last, 30);
  labels.setTo(12.0F);
  labels(cv::Rect(20, 10, 7, 1)).setTo(30.0F);
  EXPECT_EQ(findSupportedLabels(valleys(labels), pool)->all.last, 12) << "seven pixels are too few";
}

TEST(LabelSupport, PixelsThatDoNotCountWidenNothing)
{
  cv::Mat labels = everywhere(12.0F);
  labels(cv::Rect(20, 10, 4, 4)).setTo(30.0F);
  std::vector<std::uint8_t> trusted(static_cast<std::size_t>(SIZE.area()), 1);
  for (int y = 10; y < 14; ++y)
  {
    std::fill_n(trusted.begin() + y * SIZE.width + 20, 4, std::uint8_t{0});
  }
  ThreadPool pool(1);
  EXPECT_EQ(findSupportedLabels(valleys(labels), pool, trusted)->all.last, 12);
}

TEST(LabelSupport, EqualCostsSupportNothing)
{
  SweepCosts flat = valleys(everywhere(12.0F));
  flat.values.setTo(5 * PER_LEVEL);
  ThreadPool pool(1);
  EXPECT_FALSE(findSupportedLabels(flat, pool));
  const std::vector<float> likely = findLikelyLabels(flat, pool);
  EXPECT_TRUE(std::all_of(likely.begin(), likely.end(), [](float label) { return std::isnan(label); }));
}

TEST(LabelSupport, ASecondMinimumThatIsAsGoodMakesUncertain)
{
  SweepCosts repeated = valleys(everywhere(12.0F));
  const SweepCosts other = valleys(everywhere(22.0F));
  cv::min(repeated.values, other.values, repeated.values);
  ThreadPool pool(1);
  EXPECT_FALSE(findSupportedLabels(repeated, pool));
}

TEST(LabelSupport, LikelyLabelsLieBetweenLabels)
{
  SweepCosts volume = valleys(everywhere(12.0F));
  // The parabola through 33, 1 and 17 above the least cost: its vertex is a sixth of a label to the right.
  for (int i = 0; i < SIZE.area(); ++i)
  {
    volume.cost(11)[i] = 33;
    volume.cost(12)[i] = 1;
    volume.cost(13)[i] = 17;
  }
  ThreadPool pool(1);
  const std::vector<float> likely = findLikelyLabels(volume, pool);
  EXPECT_FLOAT_EQ(likely[0], 12.0F + 1.0F / 6.0F);
  EXPECT_FLOAT_EQ(likely.back(), likely[0]);
}

}  // namespace
}  // namespace light_field_depth
