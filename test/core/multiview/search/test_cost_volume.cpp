#include "core/multiview/search/cost_volume.h"

#include <gtest/gtest.h>

#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
const LabelSpace LABELS{-1.0F, 0.125F, 25};  // -1 to 2 pixels
constexpr int WALL = 4;                      // -0.5 pixels
constexpr int BOX = 20;                      // 1.5 pixels
const cv::Rect BOX_AREA(40, 24, 40, 32);

const LightField& scene()
{
  static const LightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {128, 80};
    settings.positions = testing::crossPositions(5, 5);
    settings.samples = 1;
    return testing::renderScene({testing::plane(-0.5, 0.0, 0.0, testing::noiseTexture(1, 8.0)),
                                 testing::rectangle(1.5, BOX_AREA, testing::noiseTexture(2, 8.0))},
                                settings)
        .light_field;
  }();
  return rendered;
}

class CostVolumeTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    ViewSetSettings settings;
    settings.range = {-1.0F, 2.0F};
    prepareViews(scene(), settings, pool_, views_);
    bands_.setAll(views_.width(), views_.height(), LABELS.count);
  }

  int bestLabel(int x, int y) const
  {
    int best = volume_.bandAt(x, y).first;
    for (int label = best; label < volume_.bandAt(x, y).first + volume_.bandAt(x, y).count; ++label)
    {
      best = volume_.at(x, y, label) < volume_.at(x, y, best) ? label : best;
    }
    return best;
  }

  /// Share of the pixels of an area whose best label is at most one off.
  double shareOfRight(const cv::Rect& area, int label) const
  {
    int right = 0;
    for (int y = area.y; y < area.y + area.height; ++y)
    {
      for (int x = area.x; x < area.x + area.width; ++x)
      {
        right += std::abs(bestLabel(x, y) - label) <= 1 ? 1 : 0;
      }
    }
    return right / static_cast<double>(area.area());
  }

  ThreadPool pool_{2};
  ViewSet views_;
  LabelBands bands_;
  CostVolumeBuilder builder_;
  CostVolume volume_;
};

TEST_F(CostVolumeTest, TheTrueLabelCostsLeast)
{
  builder_.buildFromArms(views_, LABELS, bands_, {}, pool_, volume_);
  EXPECT_GT(shareOfRight({46, 30, 28, 20}, BOX), 0.9);
  EXPECT_GT(shareOfRight({8, 8, 24, 64}, WALL), 0.9);
}

TEST_F(CostVolumeTest, APointThatAnOccluderHidesFromSomeIsNotChargedForThem)
{
  builder_.buildFromArms(views_, LABELS, bands_, {}, pool_, volume_);
  // Four pixels beside the box: hidden from the views towards which the box moves.
  EXPECT_GT(shareOfRight({36, 28, 4, 24}, WALL), 0.8);
  EXPECT_GT(shareOfRight({80, 28, 4, 24}, WALL), 0.8);
}

TEST_F(CostVolumeTest, WhoKnowsWhatIsSeenChargesOnlyThose)
{
  cv::Mat truth(80, 128, CV_32FC1, cv::Scalar(-0.5));
  truth(BOX_AREA).setTo(1.5);
  VisibleSurfaces surfaces;
  surfaces.warp(truth, views_, LABELS, pool_);
  builder_.buildFromVisible(views_, LABELS, bands_, surfaces, {}, pool_, volume_);
  EXPECT_GT(shareOfRight({36, 28, 4, 24}, WALL), 0.8);
  EXPECT_GT(shareOfRight({46, 30, 28, 20}, BOX), 0.9);
}

TEST_F(CostVolumeTest, EachTileHasTheLabelsOfItsBandWithTheSameCosts)
{
  builder_.buildFromArms(views_, LABELS, bands_, {}, pool_, volume_);
  const CostVolume full = volume_;
  LabelBands narrow = bands_;
  narrow.setAround(cv::Mat(80, 128, CV_32FC1, cv::Scalar(LABELS.disparity(WALL))), LABELS, 8, 2.0F, pool_);
  builder_.buildFromArms(views_, LABELS, narrow, {}, pool_, volume_);
  EXPECT_LT(volume_.size(), full.size());
  const LabelBand& band = volume_.bandAt(70, 40);
  EXPECT_LE(band.first, WALL - 2);
  for (int label = band.first; label < band.first + band.count; ++label)
  {
    EXPECT_EQ(volume_.at(70, 40, label), full.at(70, 40, label)) << label;
  }
}

TEST_F(CostVolumeTest, IsTheSameOnAnyNumberOfThreads)
{
  builder_.buildFromArms(views_, LABELS, bands_, {}, pool_, volume_);
  CostVolume other;
  ThreadPool one(1);
  CostVolumeBuilder().buildFromArms(views_, LABELS, bands_, {}, one, other);
  for (int y = 0; y < 80; ++y)
  {
    for (int x = 0; x < 128; ++x)
    {
      for (int label = 0; label < LABELS.count; ++label)
      {
        ASSERT_EQ(volume_.at(x, y, label), other.at(x, y, label));
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
