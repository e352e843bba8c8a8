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

TEST(DatasetLayout, TakesTheGridThatIsGiven)
{
  const TemporaryFolder folder;
  testing::grid({4, 3}, [](int r, int c) { return "v" + testing::padded(r * 4 + c, 2) + ".png"; })(
      folder, testing::RenderedScene::view);
  DatasetOptions options;
  options.grid = cv::Size(4, 3);
  EXPECT_EQ(readDataset(folder.path(), options).light_field.reference().grid, (GridPosition{1, 1}));
  options.grid = cv::Size(3, 3);
  EXPECT_NE(testing::messageOf<InputError>([&] { readDataset(folder.path(), options); }).find("--grid"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
