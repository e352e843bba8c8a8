#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/search/change_detection.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 128;
constexpr int HEIGHT = 128;
constexpr int LABEL_COUNT = 20;

class ChangeDetection : public testing::Test
{
protected:
  /// A frame in which the band explains every pixel, but for some.
  void observe(int changed_columns, std::uint8_t explained_cost = 10)
  {
    bands_.setAll(WIDTH, HEIGHT, LABEL_COUNT);
    for (int row = 0; row < bands_.rows(); ++row)
    {
      for (int column = 0; column < bands_.columns(); ++column)
      {
        bands_.at(row, column) = {5, 4};
      }
    }
    detector_.begin(bands_);
    std::vector<std::uint8_t> inside(WIDTH, explained_cost);
    const std::vector<std::uint8_t> outside(WIDTH, explained_cost);
    for (int y = 0; y < HEIGHT; ++y)
    {
      if (detector_.wants(y))
      {
        ++observed_rows_;
        std::vector<std::uint8_t> row = inside;
        for (int x = 0; y < TILE_PX && x < changed_columns; ++x)
        {
          row[static_cast<std::size_t>(x)] = 60;
        }
        detector_.observe(y, row.data(), outside.data(), WIDTH);
      }
    }
  }

  ChangeDetector detector_;
  LabelBands bands_;
  std::vector<std::uint8_t> widened_;
  int observed_rows_ = 0;
};

TEST_F(ChangeDetection, EveryEighthRowIsLookedAt)
{
  observe(0);
  EXPECT_EQ(observed_rows_, HEIGHT / 8);
}

TEST_F(ChangeDetection, AFrameThatItsBandsExplainIsAcceptedAsItIs)
{
  observe(0);
  detector_.acceptFull();
  observe(0);
  ASSERT_TRUE(detector_.acceptNear(bands_, widened_));
  EXPECT_EQ(widened_, std::vector<std::uint8_t>(16, 0));
}

TEST_F(ChangeDetection, ATileThatChangedIsSearchedInFullWithItsNeighbours)
{
  observe(0);
  detector_.acceptFull();
  observe(1);
  ASSERT_TRUE(detector_.acceptNear(bands_, widened_));
  EXPECT_EQ(widened_, (std::vector<std::uint8_t>{1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bands_.at(1, 1).count, LABEL_COUNT);
  EXPECT_EQ(bands_.at(2, 2).count, 4);
}

TEST_F(ChangeDetection, AFrameThatNoLabelExplainsIsAnotherScene)
{
  observe(0);
  detector_.acceptFull();
  observe(0, 200);
  EXPECT_FALSE(detector_.acceptNear(bands_, widened_));
}

TEST_F(ChangeDetection, AMapThatFillsTheEndsOfTheRangeIsNotBelieved)
{
  const LabelSpace labels{0.0F, 0.25F, LABEL_COUNT};
  const cv::Mat inside(HEIGHT, WIDTH, CV_32FC1, 1.0F);
  detector_.acceptFullMap(inside, labels);
  EXPECT_TRUE(detector_.acceptNearMap(inside, labels));
  cv::Mat at_end = inside.clone();
  at_end.rowRange(0, 1).setTo(labels.disparity(LABEL_COUNT - 1));  // 1 / 128 of the pixels, more than 0.3 %
  EXPECT_FALSE(detector_.acceptNearMap(at_end, labels));
}

}  // namespace
}  // namespace light_field_depth::multiview
