#include <gtest/gtest.h>

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

}  // namespace
}  // namespace light_field_depth
