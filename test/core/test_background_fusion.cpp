#include <gtest/gtest.h>

#include <algorithm>

#include "light_field_depth/core/multiview/background_fusion.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 192;
constexpr int HEIGHT = 64;
constexpr int LABELS = 20;
constexpr int BACKGROUND = 4;
constexpr int FOREGROUND = 14;
/// Pixels that the first search left at the foreground's label.
const cv::Rect STRAY(80, 20, 30, 24);

/// A textured background with a part in the middle about which `stray_costs` knows, and a first search that
/// has left that part in front.
class BackgroundFusionTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    volume_.create(WIDTH, HEIGHT, LABELS);
    cv::Mat image(HEIGHT, WIDTH, CV_8UC1, cv::Scalar(90));
    preparePlanar(image, {}, 4, guide_);
    first_search_ = cv::Mat(HEIGHT, WIDTH, CV_32FC1, cv::Scalar(labels_.disparity(BACKGROUND)));
    background_map_ = first_search_.clone();
    first_search_(STRAY).setTo(labels_.disparity(FOREGROUND));
  }

  /// Costs that are 0 at a label and 60 elsewhere, but the same everywhere where there is no label.
  void fill(int stray_label)
  {
    for (int y = 0; y < HEIGHT; ++y)
    {
      for (int x = 0; x < WIDTH; ++x)
      {
        std::uint8_t* const costs = volume_.values.data() + volume_.rowOffset(y) + x * volume_.pitch;
        const int label = STRAY.contains({x, y}) ? stray_label : BACKGROUND;
        std::fill(costs, costs + LABELS, std::uint8_t{label < 0 ? std::uint8_t{20} : std::uint8_t{60}});
        if (label >= 0)
        {
          costs[label] = 0;
        }
      }
    }
  }

  cv::Mat fused()
  {
    const PathSettings paths;
    cv::Mat labels;
    aggregator_.aggregate(volume_, guide_, paths, pool_, labels);
    cv::Mat disparity = first_search_.clone();
    fusion_.prepare(labels_, disparity, {}, pool_, volume_);
    fusion_.fuse(volume_, aggregator_, paths, background_map_, disparity);
    return disparity;
  }

  ThreadPool pool_{2};
  LabelSpace labels_{-1.0F, 0.125F, LABELS};
  CostVolume volume_;
  PlanarImage guide_;
  cv::Mat first_search_;
  cv::Mat background_map_;
  PathAggregator aggregator_;
  BackgroundFusion fusion_;
};

TEST_F(BackgroundFusionTest, ARegionThatTheImagesDoNotKnowGoesBack)
{
  fill(-1);
  EXPECT_EQ(cv::norm(fused(), background_map_, cv::NORM_INF), 0.0);
}

TEST_F(BackgroundFusionTest, ARegionThatTheImagesSupportStays)
{
  fill(FOREGROUND);
  EXPECT_EQ(cv::norm(fused(), first_search_, cv::NORM_INF), 0.0);
}

TEST_F(BackgroundFusionTest, TheChargeGrowsFromTheFloor)
{
  fill(-1);
  fused();
  const std::uint8_t* const costs = volume_.values.data() + volume_.rowOffset(30) + 90 * volume_.pitch;
  EXPECT_EQ(costs[BACKGROUND], 20);
  EXPECT_EQ(costs[BACKGROUND + 2], 23);
  EXPECT_EQ(costs[BACKGROUND + 10], 35);
}

TEST_F(BackgroundFusionTest, LaterSearchesAreHeldWhereItMoved)
{
  fill(-1);
  fused();
  fill(-1);
  fusion_.hold(pool_, volume_);
  const auto cost = [&](int x, int label)
  { return volume_.values[volume_.rowOffset(30) + static_cast<std::size_t>(x * volume_.pitch + label)]; };
  EXPECT_EQ(cost(90, BACKGROUND + 3), 20);
  EXPECT_EQ(cost(90, BACKGROUND + 6), 26);
  EXPECT_EQ(cost(90, LABELS - 1), 40);
  EXPECT_EQ(cost(20, LABELS - 1), 60);
}

}  // namespace
}  // namespace light_field_depth::multiview
