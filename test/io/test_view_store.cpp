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

TEST(ViewStore, AGreyReferenceMakesAllViewsGrey)
{
  const TemporaryFolder folder;
  testing::write(folder, "left.png", cv::Mat(20, 24, CV_8UC1, 100.0));
  testing::write(folder, "right.png", cv::Mat(20, 24, CV_8UC3, cv::Scalar::all(100.0)));
  const Dataset dataset = readDataset(folder.path());
  for (const View& view : dataset.light_field.views)
  {
    EXPECT_EQ(view.image.type(), CV_8UC1);
    EXPECT_EQ(cv::mean(view.image)[0], 100.0);
  }
  EXPECT_EQ(dataset.notes.size(), 1U);
}

}  // namespace
}  // namespace light_field_depth
