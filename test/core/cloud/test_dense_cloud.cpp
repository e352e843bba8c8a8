#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/point_cloud.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr int WIDTH = 64;
constexpr int HEIGHT = 48;

/// 3 x 3 views of a grey world; f B = 10, d_inf = 5.
LightField greyField()
{
  std::vector<View> views;
  for (const GridPosition& position : testing::gridPositions(3, 3))
  {
    views.push_back(
        gridView(position.row, position.column, cv::Mat(HEIGHT, WIDTH, CV_8UC3, cv::Scalar(1, 2, 3))));
  }
  Calibration calibration;
  calibration.focal_length_px = 100.0;
  calibration.principal_point_px = {31.5, 23.5};
  calibration.baseline_m = 0.1;
  calibration.disparity_offset_px = 5.0;
  return makeLightField(std::move(views), std::nullopt, calibration);
}

constexpr std::size_t CENTRE = 4;

ViewDisparity constantMap(std::size_t view, float disparity)
{
  return {view, cv::Mat(HEIGHT, WIDTH, CV_32FC1, cv::Scalar(disparity)),
          cv::Mat::ones(HEIGHT, WIDTH, CV_32FC1)};
}

std::vector<DensePoint> cloudOf(const std::vector<ViewDisparity>& maps, const DenseCloudOptions& options = {},
                                int threads = 2)
{
  ThreadPool pool(threads);
  return denseCloud(greyField(), maps, options, pool);
}

bool identical(const std::vector<DensePoint>& a, const std::vector<DensePoint>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(DensePoint)) == 0;
}

TEST(DenseCloud, PutsTheMapOfOneViewIntoAllOnOneSurface)
{
  // At disparity 2 a view to the side loses two columns or rows of 48 and 64.
  const auto cloud = cloudOf({constantMap(CENTRE, 2.0F)});
  EXPECT_EQ(cloud.size(), static_cast<std::size_t>((3 * WIDTH - 4) * (3 * HEIGHT - 4)));
  for (const DensePoint& point : cloud)
  {
    ASSERT_NEAR(point.z, 10.0 / 7.0, 1e-5);
    ASSERT_NEAR(point.normal_z, -1.0, 1e-5);
    ASSERT_EQ(point.views, 1);
    ASSERT_EQ(point.r, 3);
    ASSERT_EQ(point.b, 1);
    ASSERT_EQ(point.confidence, 1.0F);
  }
}

TEST(DenseCloud, ResamplesASlantedPlaneAndKnowsItsNormal)
{
  // f B / Z = 7 + 0.05 (x - 31.5) + 0.02 (y - 23.5): a plane, with displacements of fractions of pixels.
  ViewDisparity map = constantMap(CENTRE, 0.0F);
  for (int y = 0; y < HEIGHT; ++y)
  {
    for (int x = 0; x < WIDTH; ++x)
    {
      map.disparity.at<float>(y, x) =
          2.0F + 0.05F * (static_cast<float>(x) - 31.5F) + 0.02F * (static_cast<float>(y) - 23.5F);
    }
  }
  const auto cloud = cloudOf({map});
  EXPECT_GT(cloud.size(), static_cast<std::size_t>(6 * WIDTH * HEIGHT));
  // Of the plane 5 X + 2 Y + 7 Z = 10.
  const double length = std::sqrt(25.0 + 4.0 + 49.0);
  std::size_t exact = 0;
  for (const DensePoint& point : cloud)
  {
    const double off = (5.0 * point.x + 2.0 * point.y + 7.0 * point.z - 10.0) / length;
    const double angle = -(5.0 * point.normal_x + 2.0 * point.normal_y + 7.0 * point.normal_z) / length;
    exact += static_cast<std::size_t>(std::abs(off) < 1e-4 && angle > 0.9999);
    ASSERT_LT(std::abs(off), 0.02);
    ASSERT_GT(angle, 0.9);
  }
  EXPECT_GT(exact, cloud.size() * 8 / 10)
      << "all but what lies at the borders of the map, where windows are mirrored";
}

TEST(DenseCloud, DropsWhatHangsBetweenTwoSurfaces)
{
  ViewDisparity map = constantMap(CENTRE, 1.0F);
  map.disparity.colRange(0, 30).setTo(4.0F);
  map.disparity.col(30).setTo(2.5F);
  for (const DensePoint& point : cloudOf({map}))
  {
    const bool on_a_surface =
        std::abs(point.z - 10.0F / 9.0F) < 1e-3F || std::abs(point.z - 10.0F / 6.0F) < 1e-3F;
    ASSERT_TRUE(on_a_surface) << point.z;
  }
}

TEST(DenseCloud, LeavesOutWhatIsUnknownFilledOrUnsure)
{
  ViewDisparity map = constantMap(CENTRE, 0.0F);
  map.disparity.at<float>(0, 0) = std::nanf("");
  map.confidence.at<float>(10, 10) = 0.0F;
  map.confidence.at<float>(20, 20) = 0.05F;
  EXPECT_EQ(cloudOf({map}).size(), static_cast<std::size_t>(9 * (WIDTH * HEIGHT - 2)))
      << "what lies between pixels of one surface is closed: all but the corner and the unsure pixels";
}

TEST(DenseCloud, NeedsTheVotesOfSeveralMaps)
{
  // Two agree, the third says something else in a square: there the two win.
  ViewDisparity wrong = constantMap(5, 2.0F);
  wrong.disparity(cv::Rect(20, 15, 20, 15)).setTo(0.5F);
  wrong.confidence(cv::Rect(20, 15, 20, 15)).setTo(0.1F);
  for (const DensePoint& point : cloudOf({constantMap(CENTRE, 2.0F), constantMap(3, 2.0F), wrong}))
  {
    ASSERT_NEAR(point.z, 10.0 / 7.0, 1e-4);
    ASSERT_GE(point.views, 2);
  }
  // Everybody for himself: nothing is left.
  EXPECT_TRUE(cloudOf({constantMap(CENTRE, 2.0F), constantMap(3, 1.0F), constantMap(5, 3.0F)}).empty());
}

ViewDisparity constantMap(std::size_t view, float disparity, float confidence)
{
  ViewDisparity map = constantMap(view, disparity);
  map.confidence.setTo(confidence);
  return map;
}

TEST(DenseCloud, AgreementOfUnsureMapsIsNotEnough)
{
  const auto of_confidence = [](float confidence)
  {
    return cloudOf({constantMap(CENTRE, 2.0F, confidence), constantMap(3, 2.0F, confidence),
                    constantMap(5, 2.0F, confidence)});
  };
  EXPECT_TRUE(of_confidence(0.05F).empty());
  EXPECT_FALSE(of_confidence(0.15F).empty());
}

TEST(DenseCloud, KeepsWhatOutlinesOfOtherMapsHide)
{
  // A board before a wall. In the maps of the other views it is a row too large above and below.
  std::vector<ViewDisparity> maps = {constantMap(CENTRE, 1.0F), constantMap(3, 1.0F, 0.9F),
                                     constantMap(5, 1.0F, 0.9F)};
  maps[0].disparity(cv::Rect(20, 15, 20, 15)).setTo(3.0F);
  maps[1].disparity(cv::Rect(23, 14, 20, 17)).setTo(3.0F);
  maps[2].disparity(cv::Rect(17, 14, 20, 17)).setTo(3.0F);
  std::size_t alone = 0;
  for (const DensePoint& point : cloudOf(maps))
  {
    if (point.views == 1)
    {
      ++alone;
      ASSERT_NEAR(point.z, 10.0 / 6.0, 1e-4);
    }
  }
  EXPECT_GE(alone, std::size_t{40}) << "the two rows of the view in the middle, 20 pixels wide";
  // Where no other map shows that wall, it is a contradiction.
  for (std::size_t i = 1; i < maps.size(); ++i)
  {
    maps[i].disparity.setTo(3.0F);
  }
  for (const DensePoint& point : cloudOf(maps))
  {
    ASSERT_NEAR(point.z, 10.0 / 8.0, 1e-4);
  }
}

TEST(DenseCloud, TakesWhatAPlaneHoldsFromItsOwnViewAlone)
{
  ViewDisparity map = constantMap(CENTRE, 2.0F);
  const cv::Rect blank(20, 15, 10, 8);
  map.held = cv::Mat::zeros(HEIGHT, WIDTH, CV_32FC1);
  map.held(blank).setTo(0.25F);
  map.confidence(blank).setTo(0.0F);
  std::size_t held = 0;
  for (const DensePoint& point : cloudOf({map}))
  {
    held += point.confidence == 0.25F ? 1 : 0;
    ASSERT_NEAR(point.z, 10.0 / 7.0, 1e-4);
  }
  EXPECT_EQ(held, static_cast<std::size_t>(blank.area()));
  DenseCloudOptions surer;
  surer.min_confidence = 0.3F;
  for (const DensePoint& point : cloudOf({map}, surer))
  {
    ASSERT_EQ(point.confidence, 1.0F);
  }
  // A sure map that sees something behind it is right.
  const ViewDisparity other = constantMap(3, 0.0F);
  for (const DensePoint& point : cloudOf({map, other}))
  {
    ASSERT_NE(point.confidence, 0.25F);
  }
}

TEST(DenseCloud, DropsWhatASureMapSeesThrough)
{
  // Two maps have a board that the third, which is sure, does not see: it looks at the wall behind.
  std::vector<ViewDisparity> maps = {constantMap(CENTRE, 1.0F), constantMap(1, 1.0F), constantMap(7, 1.0F)};
  for (std::size_t i = 0; i < 2; ++i)
  {
    maps[i].disparity(cv::Rect(20, 15, 20, 15)).setTo(3.0F);
  }
  for (const DensePoint& point : cloudOf(maps))
  {
    ASSERT_NEAR(point.z, 10.0 / 6.0, 1e-4);
  }
  maps[2].confidence.setTo(0.05F);
  const auto cloud = cloudOf(maps);
  EXPECT_TRUE(std::any_of(cloud.begin(), cloud.end(), [](const DensePoint& point) { return point.z < 1.3F; }))
      << "a map that is not sure contradicts nobody";
}

TEST(DenseCloud, MergesVoxelsIntoTheirWeightedMeansForAnyNumberOfThreads)
{
  std::vector<ViewDisparity> maps = {constantMap(CENTRE, 0.0F)};
  cv::RNG random(5);
  random.fill(maps[0].disparity, cv::RNG::UNIFORM, 0.0, 0.05);
  random.fill(maps[0].confidence, cv::RNG::UNIFORM, 0.2, 1.0);
  DenseCloudOptions options;
  const auto cloud = cloudOf(maps, options);
  options.voxel_size_m = 0.1F;
  options.min_views = 1;
  const auto merged = cloudOf(maps, options);

  using Key = std::array<int, 3>;
  const auto keyOf = [&](const DensePoint& point)
  {
    const auto cell = [&](float position)
    { return static_cast<int>(std::floor(position * (1.0 / options.voxel_size_m))); };
    return Key{cell(point.x), cell(point.y), cell(point.z)};
  };
  std::map<Key, std::vector<DensePoint>> expected;
  for (const DensePoint& point : cloud)
  {
    expected[keyOf(point)].push_back(point);
  }
  ASSERT_EQ(merged.size(), expected.size());
  const auto mean = [](const std::vector<DensePoint>& points, const auto& value)
  {
    double sum = 0.0;
    double weight = 0.0;
    for (const DensePoint& point : points)
    {
      sum += (0.05 + point.confidence) * value(point);
      weight += 0.05 + point.confidence;
    }
    return sum / weight;
  };
  std::size_t found = 0;
  for (const DensePoint& point : merged)
  {
    const auto voxel = expected.find(keyOf(point));
    if (voxel == expected.end())
    {
      continue;  // a mean on the face of its cube, rounded out of it
    }
    ++found;
    EXPECT_NEAR(point.x, mean(voxel->second, [](const auto& p) { return p.x; }), 1e-5);
    EXPECT_NEAR(point.z, mean(voxel->second, [](const auto& p) { return p.z; }), 1e-5);
    EXPECT_NEAR(point.confidence, mean(voxel->second, [](const auto& p) { return p.confidence; }), 1e-5);
    EXPECT_EQ(point.r, 3);
  }
  EXPECT_GT(found, expected.size() * 95 / 100);
  EXPECT_TRUE(identical(cloudOf(maps, options, 1), cloudOf(maps, options, 3)));
  options.voxel_size_m = 0.0F;
  EXPECT_TRUE(identical(cloudOf(maps, options, 1), cloudOf(maps, options, 3)));
}

TEST(DenseCloud, MergesOnlyWhatEnoughViewsShow)
{
  DenseCloudOptions options;
  options.voxel_size_m = 0.03F;
  options.min_views = 1;
  const auto all = cloudOf({constantMap(CENTRE, 2.0F)}, options);
  options.min_views = 9;
  const auto in_every_view = cloudOf({constantMap(CENTRE, 2.0F)}, options);
  EXPECT_GT(in_every_view.size(), all.size() / 2);
  EXPECT_LT(in_every_view.size(), all.size()) << "the borders are not in all views";
}

TEST(DenseCloud, RefusesSettingsThatMeanNothing)
{
  DenseCloudOptions options;
  options.voxel_size_m = -1.0F;
  options.min_confidence = std::nanf("");
  options.maps = 0;
  options.min_views = 0;
  EXPECT_EQ(validate(options).size(), 4U);
  EXPECT_TRUE(validate(DenseCloudOptions{}).empty());
}

}  // namespace
}  // namespace light_field_depth
