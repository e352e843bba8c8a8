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

TEST(FrameChoice, TakesTheFrameThatIsAskedFor)
{
  const TemporaryFolder folder;
  for (int frame = 0; frame < 3; ++frame)
  {
    for (int camera = 0; camera < 2; ++camera)
    {
      testing::write(folder,
                     "cam_0" + std::to_string(camera) + "/image_" + testing::padded(frame + 10, 3) + ".png",
                     cv::Mat(20, 24, CV_8UC1, 10.0 * frame + camera));
    }
  }
  DatasetOptions options;
  const Dataset first = readDataset(folder.path());
  EXPECT_EQ(first.frames, (std::vector<std::string>{"image_010", "image_011", "image_012"}));
  EXPECT_EQ(cv::mean(first.light_field.views[1].image)[0], 1.0);
  ASSERT_EQ(first.notes.size(), 1U);
  for (const char* const wanted : {"12", "image_012"})
  {
    options.frame = wanted;
    EXPECT_EQ(cv::mean(readDataset(folder.path(), options).light_field.views[1].image)[0], 21.0);
  }
  options.frame = "7";
  EXPECT_NE(testing::messageOf<InputError>([&] { readDataset(folder.path(), options); }).find("image_010"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
