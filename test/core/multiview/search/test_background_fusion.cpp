#include <gtest/gtest.h>

#include <algorithm>

#include "core/multiview/search/background_fusion.h"

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
    LabelBands bands;
    bands.setAll(WIDTH, HEIGHT, LABELS);
    volume_.create(WIDTH, HEIGHT, bands, CostVolume::Capacity::Band);
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
        const int right = STRAY.contains({x, y}) ? stray_label : BACKGROUND;
        for (int label = 0; label < LABELS; ++label)
        {
          const int wrong_cost = right < 0 ? 20 : 60;
          volume_.values[volume_.index(x, y, label)] =
              static_cast<std::uint8_t>(label == right ? 0 : wrong_cost);
        }
      }
    }
  }

  cv::Mat fused()
  {
    const PathSettings paths;
    cv::Mat labels;
    aggregator_.setGuide(guide_, paths, pool_);
    aggregator_.aggregate(volume_, paths, pool_, labels);
    cv::Mat disparity = first_search_.clone();
    fusion_.prepare(labels_, disparity, pool_, volume_);
    fusion_.fuse(volume_, aggregator_, paths, background_map_, pool_, disparity);
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
  EXPECT_EQ(volume_.at(90, 30, BACKGROUND), 20);
  EXPECT_EQ(volume_.at(90, 30, BACKGROUND + 2), 23);
  EXPECT_EQ(volume_.at(90, 30, BACKGROUND + 10), 35);
}

TEST_F(BackgroundFusionTest, LaterSearchesAreHeldWhereItMoved)
{
  fill(-1);
  fused();
  fill(-1);
  fusion_.chargeMoved(labels_, pool_, volume_);
  EXPECT_EQ(volume_.at(90, 30, BACKGROUND + 2), 20);
  EXPECT_EQ(volume_.at(90, 30, BACKGROUND + 6), 28);
  EXPECT_EQ(volume_.at(90, 30, LABELS - 1), 40);
  EXPECT_EQ(volume_.at(20, 30, LABELS - 1), 60);
}

TEST_F(BackgroundFusionTest, ALaterSearchMayHaveOtherLabels)
{
  fill(-1);
  fused();
  LabelSpace finer = labels_;
  finer.step_px /= 2.0F;
  finer.count = 2 * LABELS - 1;
  LabelBands bands;
  bands.setAll(WIDTH, HEIGHT, finer.count);
  volume_.create(WIDTH, HEIGHT, bands, CostVolume::Capacity::Band);
  std::fill(volume_.values.begin(), volume_.values.end(), std::uint8_t{20});
  fusion_.chargeMoved(finer, pool_, volume_);
  EXPECT_EQ(volume_.at(90, 30, 2 * BACKGROUND + 4), 20);
  EXPECT_EQ(volume_.at(90, 30, 2 * BACKGROUND + 12), 28);
  EXPECT_EQ(volume_.at(20, 30, finer.count - 1), 20);
}

}  // namespace
}  // namespace light_field_depth::multiview
