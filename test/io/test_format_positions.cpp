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

TEST(FormatPositions, TakesTheCalibrationOfBlendersNames)
{
  const TemporaryFolder folder;
  testing::grid(testing::FIVE,
                [](int r, int c)
                {
                  return "Original Camera_" + testing::padded(4 - r, 2) + "_" + testing::padded(4 - c, 2) +
                         "_" + std::to_string(30.75 * (r - 2)) + "_" + std::to_string(30.75 * (c - 2)) +
                         "_30_36.png";
                })(folder, testing::RenderedScene::view);
  const Dataset dataset = readDataset(folder.path());
  ASSERT_TRUE(dataset.light_field.calibration);
  EXPECT_NEAR(dataset.light_field.calibration->focal_length_px, 80.0 * 30.0 / 36.0, 1e-9);
  EXPECT_NEAR(dataset.light_field.calibration->baseline_m, 0.03075, 1e-9);
  EXPECT_EQ(dataset.light_field.calibration->disparity_offset_px, 0.0);
}

}  // namespace
}  // namespace light_field_depth
