#include <gtest/gtest.h>

#include "core/multiview/search/label_search.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int MAX_LABELS = 240;
/// Of the distance of the labels: a search finds the nearest one.
constexpr double LABELS_OFF = 1.5;

/// The standard scene as a search takes it.
class LabelSearchTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    testing::SceneSettings settings;
    settings.size = {128, 96};
    settings.positions = testing::crossPositions(9, 9);
    settings.samples = 2;
    scene_ = testing::renderScene(testing::standardScene(settings.size), settings);
    ViewSetSettings view_settings;
    view_settings.range = {-1.4F, 2.2F};
    labels_ = makeLabelSpace(view_settings.range, 0.125F, MAX_LABELS);
    prepareViews(scene_.light_field, view_settings, pool_, views_);
  }

  bool run(const SearchSettings& settings, const cv::Mat& around = cv::Mat())
  {
    return search_.run({views_, views_.reference, labels_}, settings, around, context_, maps_);
  }

  double badPercentage(const cv::Mat& map) const
  {
    return testing::badPercentage(map, scene_.truth, LABELS_OFF * labels_.step_px);
  }

  ThreadPool pool_{2};
  RunContext context_{pool_};
  testing::SyntheticLightField scene_;
  ViewSet views_;
  LabelSpace labels_;
  LabelSearch search_;
  SearchMaps maps_;
};

TEST_F(LabelSearchTest, KnowingWhichViewsSeeMakesTheLastMapTheBetterOne)
{
  ASSERT_TRUE(run({}));
  EXPECT_LT(badPercentage(maps_.first), 12.0);
  EXPECT_LT(badPercentage(maps_.last), 4.0);
  EXPECT_LT(badPercentage(maps_.last), badPercentage(maps_.first));
}

TEST_F(LabelSearchTest, TheFirstMapMayHaveFewerLabelsThanTheLast)
{
  SearchSettings settings;
  settings.first_label_step_share = 1.0F;
  ASSERT_TRUE(run(settings));
  const double all = badPercentage(maps_.last);
  settings.first_label_step_share = 4.0F;
  ASSERT_TRUE(run(settings));
  EXPECT_LT(badPercentage(maps_.last), all + 1.0);
}

TEST_F(LabelSearchTest, WithoutVisibilityTheFirstMapIsTheLast)
{
  SearchSettings settings;
  settings.visibility_passes = 0;
  ASSERT_TRUE(run(settings));
  EXPECT_EQ(cv::norm(maps_.first, maps_.last, cv::NORM_INF), 0.0);
}

TEST_F(LabelSearchTest, LabelsFarFromTheGivenMapAreNotTried)
{
  const float away_px = labels_.disparity(0.0F);
  ASSERT_TRUE(run({}, cv::Mat(scene_.truth.size(), CV_32FC1, cv::Scalar(away_px))));
  double most = 0.0;
  cv::minMaxIdx(maps_.first, nullptr, &most);
  EXPECT_LT(most, away_px + 1.0F) << "a few labels more than the map has";
}

TEST_F(LabelSearchTest, AnotherSceneIsNotSearchedNearTheLastOnesMap)
{
  SearchSettings settings;
  settings.detect_changes = true;
  ASSERT_TRUE(run(settings));
  const cv::Mat last = maps_.last.clone();
  EXPECT_TRUE(run(settings, last));
  LightField other = scene_.light_field;
  cv::RNG random(6);
  for (View& view : other.views)
  {
    view.image = cv::Mat(view.image.size(), view.image.type());
    random.fill(view.image, cv::RNG::UNIFORM, 0, 256);
  }
  prepareViews(other, {}, pool_, views_);
  EXPECT_FALSE(run(settings, last));
}

}  // namespace
}  // namespace light_field_depth::multiview
