// Light fields of cameras and of the HCI benchmark, where they are at hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/geometry.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
const std::filesystem::path DATA = "../shared/data";

cv::Mat greyFloat(const cv::Mat& image)
{
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  return grey;
}

/// Mean absolute difference of the reference view and a view that is moved back by one disparity, in a part
/// of the image given in fractions of its size.
double differenceAt(const LightField& light_field, const View& view, const cv::Rect2d& part, double disparity)
{
  const cv::Size size = light_field.size();
  const cv::Rect area(static_cast<int>(part.x * size.width), static_cast<int>(part.y * size.height),
                      static_cast<int>(part.width * size.width), static_cast<int>(part.height * size.height));
  const cv::Matx23d shift(1, 0, area.x - disparity * view.steps.x, 0, 1, area.y - disparity * view.steps.y);
  cv::Mat moved;
  cv::warpAffine(view.image, moved, shift, area.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  return cv::norm(greyFloat(light_field.reference().image(area)), greyFloat(moved), cv::NORM_L1) /
         area.area();
}

/// The disparity at which the views near the reference view agree best in a part of the image.
double bestDisparity(const LightField& light_field, const cv::Rect2d& part, double largest)
{
  double best = 0.0;
  double best_difference = std::numeric_limits<double>::infinity();
  for (double disparity = -largest; disparity <= largest; disparity += 0.25)
  {
    double sum = 0.0;
    for (const View& view : light_field.views)
    {
      if (std::abs(view.steps.x) < 2.5 && std::abs(view.steps.y) < 2.5)
      {
        sum += differenceAt(light_field, view, part, disparity);
      }
    }
    if (sum < best_difference)
    {
      best_difference = sum;
      best = disparity;
    }
  }
  return best;
}

TEST(RealDatasets, HciDepthFollowsFromDisparity)
{
  const auto folder = DATA / "hci/cotton";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const Dataset dataset = readDataset(folder);
  EXPECT_EQ(dataset.format, "hci");
  EXPECT_EQ(dataset.light_field.views.size(), 81U);
  ASSERT_TRUE(dataset.truth);
  ASSERT_TRUE(dataset.light_field.calibration);
  const cv::Mat disparity = readPfm(*dataset.truth);
  const cv::Mat expected = readPfm(folder / "gt_depth_lowres.pfm");
  const cv::Mat depth = depthMap(disparity, *dataset.light_field.calibration);
  ASSERT_EQ(depth.size(), expected.size());
  cv::Mat relative;
  cv::divide(cv::abs(depth - expected), expected, relative);
  // The benchmark has made the two maps smaller one by one, so they disagree at some edges.
  EXPECT_LT(cv::countNonZero(relative > 1e-3), 0.001 * static_cast<double>(relative.total()));
  EXPECT_LT(cv::mean(relative)[0], 1e-4);
  double smallest = 0.0;
  double largest = 0.0;
  cv::minMaxIdx(disparity, &smallest, &largest);
  EXPECT_LE(dataset.disparity_range->min, smallest);
  EXPECT_GE(dataset.disparity_range->max, largest);
}

TEST(RealDatasets, HciDisparityIsPositiveNearer)
{
  const auto folder = DATA / "hci/cotton";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const Dataset dataset = readDataset(folder);
  const cv::Rect2d part(0.45, 0.45, 0.1, 0.1);
  const cv::Mat truth = readPfm(*dataset.truth);
  const cv::Rect area(230, 230, 51, 51);
  EXPECT_NEAR(bestDisparity(dataset.light_field, part, 3.0), cv::mean(truth(area))[0], 0.3);
}

TEST(RealDatasets, AnHciFolderWithoutParametersHasNoCalibration)
{
  const auto folder = DATA / "hci/antinous";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const Dataset dataset = readDataset(folder);
  EXPECT_FALSE(dataset.light_field.calibration);
  EXPECT_FALSE(dataset.disparity_range);
  EXPECT_TRUE(dataset.truth);
}

TEST(RealDatasets, LytroViewsArePrefixedAndCountedFromOne)
{
  const auto folder = DATA / "lytro/2067";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const Dataset dataset = readDataset(folder);
  EXPECT_EQ(dataset.format, "grid");
  EXPECT_EQ(dataset.light_field.size(), cv::Size(552, 383));
  EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{5, 5}));
}

TEST(RealDatasets, EveryFolderIsRecognised)
{
  struct Folder
  {
    const char* path;
    const char* format;
    std::size_t views;
    bool calibrated;
  };
  for (const Folder& folder :
       {Folder{"lytro/general_11", "grid", 25, false}, Folder{"lytro/flowers", "grid", 100, false},
        Folder{"array/toys", "index", 256, false}, Folder{"stereo/eth3d_playground", "middlebury", 2, true},
        Folder{"stereo/art", "index", 2, false}})
  {
    if (!std::filesystem::exists(DATA / folder.path))
    {
      GTEST_SKIP() << DATA / folder.path << " is not here";
    }
    DatasetOptions options;
    options.selection = [](const LightField&) { return ViewSelection::Row; };
    const Dataset dataset = readDataset(DATA / folder.path, options);
    EXPECT_EQ(dataset.format, folder.format) << folder.path;
    EXPECT_EQ(dataset.views_found, folder.views) << folder.path;
    EXPECT_EQ(dataset.light_field.calibration.has_value(), folder.calibrated) << folder.path;
  }
}

/// A figure stands before a wall: its disparity must be the larger one.
TEST(RealDatasets, StanfordFiguresAreNearerThanTheWallBehind)
{
  const auto folder = DATA / "stanford/lego_knights";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const Dataset dataset = readDataset(folder);
  EXPECT_EQ(dataset.format, "stanford");
  EXPECT_EQ(dataset.light_field.views.size(), 289U);
  const double knight = bestDisparity(dataset.light_field, {0.13, 0.48, 0.08, 0.12}, 4.0);
  const double wall = bestDisparity(dataset.light_field, {0.3, 0.2, 0.4, 0.15}, 4.0);
  EXPECT_GT(knight, wall + 0.4);
}

/// A doll sits before a wall with a poster; flipping turns near and far round.
TEST(RealDatasets, FlippingTurnsNearAndFarRound)
{
  const auto folder = DATA / "array/dolls";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not here";
  }
  const cv::Rect2d doll(0.4, 0.46, 0.1, 0.08);
  const cv::Rect2d poster(0.6, 0.2, 0.1, 0.1);
  for (const auto& [flip, sign] : {std::make_pair(Flip::None, 1.0), std::make_pair(Flip::Both, -1.0)})
  {
    DatasetOptions options;
    options.flip = flip;
    const LightField light_field = readDataset(folder, options).light_field;
    EXPECT_GT(sign * (bestDisparity(light_field, doll, 8.0) - bestDisparity(light_field, poster, 8.0)), 2.0)
        << toString(flip);
  }
}

TEST(RealDatasets, SwappedPairsAreReadTheRightWayRound)
{
  for (const auto& [left, right] :
       {std::make_pair("stereo/eth3d_playground/im0.png", "stereo/eth3d_playground/im1.png"),
        std::make_pair("stereo/art/view1.png", "stereo/art/view5.png")})
  {
    if (!std::filesystem::exists(DATA / left))
    {
      GTEST_SKIP() << DATA / left << " is not here";
    }
    for (const bool swapped : {false, true})
    {
      SCOPED_TRACE(std::string(left) + (swapped ? ", swapped" : ""));
      const testing::TemporaryFolder folder;
      std::filesystem::copy_file(DATA / left, folder / (swapped ? "right.png" : "left.png"));
      std::filesystem::copy_file(DATA / right, folder / (swapped ? "left.png" : "right.png"));
      const Dataset dataset = readDataset(folder.path());
      EXPECT_EQ(dataset.flip, swapped ? Flip::Columns : Flip::None);
      ASSERT_EQ(dataset.warnings.size(), swapped ? 1U : 0U);
      EXPECT_TRUE(!swapped || dataset.warnings.front().find("swapped") != std::string::npos);
      // The left camera has the smaller column.
      const LightField& pair = dataset.light_field;
      const View& first = pair.views[pair.views[0].steps.x < pair.views[1].steps.x ? 0 : 1];
      EXPECT_EQ(cv::norm(first.image, readImage(DATA / left), cv::NORM_INF), 0.0);
    }
  }
}

}  // namespace
}  // namespace light_field_depth
