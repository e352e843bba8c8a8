#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

/// Lenslets whose rims are dark, as behind a real lens; most of all those of the corners.
cv::Mat darkRimmedLenslets(const testing::Scene& scene)
{
  cv::Mat image = testing::lenslets(scene);
  constexpr double middle = 0.5 * (testing::SIDE - 1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const double radius = std::hypot(x % testing::SIDE - middle, y % testing::SIDE - middle) / middle;
      image.at<cv::Vec3b>(y, x) *= radius > 1.2 ? 0.05 : radius > 0.9 ? 0.6 : 1.0;
    }
  }
  return image;
}

TEST(FormatImage, LeavesOutTheDarkCornersOfLenslets)
{
  const TemporaryFolder folder;
  testing::write(folder, "flower_eslf.png", darkRimmedLenslets(testing::RenderedScene::view));
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "lenslets");
  EXPECT_EQ(dataset.views_found, 21U);
  EXPECT_EQ(testing::viewAt(dataset.light_field, 2, 2), nullptr);
  const View* const view = testing::viewAt(dataset.light_field, 1, -1);
  ASSERT_TRUE(view != nullptr);
  EXPECT_EQ(cv::norm(view->image, testing::RenderedScene::view(1, 3), cv::NORM_INF), 0.0);
}

/// As a table of 14 x 14 pixels a lenslet, of which only those in the middle lie behind the lens.
TEST(FormatImage, ReadsWhatIsNamedLensletsAlsoWhereTheirRimIsDark)
{
  constexpr int LENSLET_PX = 14;
  constexpr int RIM_PX = 4;
  const cv::Size size = testing::RenderedScene::view(0, 0).size();
  cv::Mat image(size * LENSLET_PX, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const int row = y % LENSLET_PX - RIM_PX;
      const int column = x % LENSLET_PX - RIM_PX;
      const bool lit = row >= 0 && row < testing::SIDE && column >= 0 && column < testing::SIDE;
      const cv::Mat view = testing::RenderedScene::view(std::clamp(row, 0, testing::SIDE - 1),
                                                        std::clamp(column, 0, testing::SIDE - 1));
      image.at<cv::Vec3b>(y, x) = view.at<cv::Vec3b>(y / LENSLET_PX, x / LENSLET_PX) * (lit ? 1.0 : 0.15);
    }
  }
  const TemporaryFolder folder;
  testing::write(folder, "IMG_0001_ESLF.png", image);
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "lenslets");
  EXPECT_EQ(dataset.views_found, 25U);
  const View* const view = testing::viewAt(dataset.light_field, 0, 0);
  ASSERT_TRUE(view != nullptr);
  EXPECT_EQ(cv::norm(view->image, testing::RenderedScene::view(2, 2), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth
