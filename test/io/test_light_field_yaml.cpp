// Folders described by a light_field.yaml.

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>

#include "dataset_files.h"
#include "light_field_depth/core/geometry.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::expectSteps;
using testing::readingError;
using testing::says;
using testing::TemporaryFolder;
using testing::twoDigits;
using testing::writeGrid;

std::string viewName(int row, int column)
{
  return "view_" + twoDigits(row) + "_" + twoDigits(column) + ".png";
}

const char* const FULL_DESCRIPTION = R"(
pattern: "view_{row:02}_{column:02}.png"
grid: {rows: 3, columns: 3}
focal_length_px: 700.0
principal_point_px: [12.5, 7.5]
baseline_m: [0.02, 0.02]
focus_distance_m: 4.0
disparity_range: [-1.9, 2.1]
truth: truth.pfm
)";

TEST(LightFieldYaml, ReadsAFullDescription)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3, viewName);
  folder.write("truth.pfm", "Pf\n1 1\n-1\n0000");
  folder.write("light_field.yaml", FULL_DESCRIPTION);
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "yaml");
  expectSteps(dataset.light_field, 3, 3,
              [](int row, int column) { return cv::Point2d(column - 1, row - 1); });
  ASSERT_TRUE(dataset.light_field.calibration);
  const Calibration& calibration = *dataset.light_field.calibration;
  EXPECT_EQ(calibration.focal_length_px, 700.0);
  EXPECT_EQ(calibration.principal_point_px, cv::Point2d(12.5, 7.5));
  EXPECT_EQ(calibration.baseline_m, 0.02);
  EXPECT_NEAR(depthFromDisparity(0.0F, calibration), 4.0, 1e-6) << "disparity 0 is on the focus plane";
  EXPECT_FLOAT_EQ(dataset.disparity_range->min, -1.9F);
  EXPECT_FLOAT_EQ(dataset.disparity_range->max, 2.1F);
  EXPECT_EQ(*dataset.truth, folder / "truth.pfm");
}

TEST(LightFieldYaml, ParallelCamerasHaveNoOffset)
{
  for (const std::string focus : {"", "focus_distance_m: .inf\n"})
  {
    const TemporaryFolder folder;
    writeGrid(folder, 1, 2, viewName);
    folder.write("light_field.yaml",
                 "pattern: view_{row:02}_{column:02}.png\ngrid: {rows: 1, columns: 2}\n"
                 "focal_length_px: 700\nbaseline_m: 0.02\n" +
                     focus);
    const Calibration calibration = readDataset(folder.path()).light_field.calibration.value();
    EXPECT_EQ(calibration.disparity_offset_px, 0.0);
    EXPECT_EQ(calibration.principal_point_px, cv::Point2d(11.5, 8.5)) << "the middle of the image by default";
  }
}

TEST(LightFieldYaml, OrdersRowsAndColumnsAsTold)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3, viewName);
  const std::string base = "pattern: view_{row:02}_{column:02}.png\ngrid: {rows: 3, columns: 3}\n";
  for (const auto& [order, sign_x, sign_y, flip] :
       {std::make_tuple("", 1, 1, Flip::None), std::make_tuple("row_order: up\n", 1, -1, Flip::Rows),
        std::make_tuple("column_order: left\n", -1, 1, Flip::Columns),
        std::make_tuple("row_order: up\ncolumn_order: left\n", -1, -1, Flip::Both),
        std::make_tuple("row_order: down\ncolumn_order: right\n", 1, 1, Flip::None)})
  {
    folder.write("light_field.yaml", base + order + "disparity_range: [-1, 2]\n");
    const Dataset dataset = readDataset(folder.path());
    const int x = sign_x;
    const int y = sign_y;
    expectSteps(dataset.light_field, 3, 3,
                [&](int row, int column) { return cv::Point2d(x * (column - 1), y * (row - 1)); });
    EXPECT_EQ(dataset.flip, flip);
    EXPECT_TRUE(dataset.disparity_range);
    DatasetOptions options;
    options.flip = Flip::None;
    const Dataset unflipped = readDataset(folder.path(), options);
    expectSteps(unflipped.light_field, 3, 3,
                [&](int row, int column) { return cv::Point2d(column - 1, row - 1); });
    EXPECT_EQ(unflipped.disparity_range.has_value(), flip == Flip::None);
  }
}

TEST(LightFieldYaml, ScalesRowsWhoseBaselineDiffers)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3, viewName);
  folder.write(
      "light_field.yaml",
      "pattern: view_{row:02}_{column:02}.png\ngrid: {rows: 3, columns: 3}\nbaseline_m: [0.02, 0.03]\n");
  const LightField light_field = readDataset(folder.path()).light_field;
  EXPECT_FALSE(light_field.calibration) << "a baseline without a focal length gives no depth";
  expectSteps(light_field, 3, 3,
              [](int row, int column) { return cv::Point2d(column - 1, 1.5 * (row - 1)); });
}

TEST(LightFieldYaml, FillsInAnyPatternAndOrigin)
{
  const TemporaryFolder folder;
  writeGrid(folder, 2, 3,
            [](int row, int column) { return "f" + std::to_string(100 + row * 3 + column) + "x.png"; });
  folder.write("light_field.yaml",
               "pattern: 'f{index:03}x.png'\ngrid: {rows: 2, columns: 3}\nfirst_index: 100\n");
  expectSteps(readDataset(folder.path()).light_field, 2, 3,
              [](int row, int column) { return cv::Point2d(column - 1, row); });

  const TemporaryFolder nested;
  for (const int row : {1, 2, 3})
  {
    std::filesystem::create_directories(nested / ("row" + std::to_string(row)));
  }
  writeGrid(nested, 3, 3,
            [](int row, int column)
            { return "row" + std::to_string(row + 1) + "/" + std::to_string(column + 7) + ".png"; });
  nested.write("light_field.yaml",
               "pattern: 'row{row}/{column}.png'\ngrid: {rows: 3, columns: 3}\nfirst: [1, 7]\n");
  const LightField light_field = readDataset(nested.path()).light_field;
  EXPECT_EQ(light_field.reference().grid, (GridPosition{2, 8}));
  expectSteps(light_field, 3, 3, [](int row, int column) { return cv::Point2d(column - 1, row - 1); });
}

TEST(LightFieldYaml, AllowsGapsInAPattern)
{
  const TemporaryFolder folder;
  writeGrid(folder, 5, 5,
            [](int row, int column)
            { return row != 0 && (row == 2 || column == 2) ? viewName(row, column) : ""; });
  folder.write("light_field.yaml", "pattern: view_{row:02}_{column:02}.png\ngrid: {rows: 5, columns: 5}\n");
  const LightField light_field = readDataset(folder.path()).light_field;
  EXPECT_EQ(light_field.views.size(), 8U);
  EXPECT_EQ(light_field.reference().grid, (GridPosition{2, 2}));
}

TEST(LightFieldYaml, ReadsAListOfViewsWithPositions)
{
  const TemporaryFolder folder;
  writeGrid(folder, 1, 3,
            [](int, int column) { return std::string(1, static_cast<char>('a' + column)) + ".png"; });
  folder.write("light_field.yaml", R"(
views:
  - {row: 0, column: 0, file: a.png, position_m: [-0.021, 0.001]}
  - {row: 0, column: 1, file: b.png, position_m: [0.0, 0.0]}
  - {row: 0, column: 2, file: c.png, position_m: [0.019, -0.002]}
focal_length_px: 500
baseline_m: 0.02
reference: [0, 1]
)");
  const LightField light_field = readDataset(folder.path()).light_field;
  EXPECT_NEAR(light_field.views[0].steps.x, -1.05, 1e-9);
  EXPECT_NEAR(light_field.views[0].steps.y, 0.05, 1e-9);
  EXPECT_NEAR(light_field.views[2].steps.x, 0.95, 1e-9);
  EXPECT_NEAR(light_field.views[2].steps.y, -0.1, 1e-9);
}

TEST(LightFieldYaml, NamesTheFieldThatIsWrong)
{
  struct Wrong
  {
    const char* description;
    const char* part;
  };
  const std::string views = "pattern: view_{row:02}_{column:02}.png\ngrid: {rows: 3, columns: 3}\n";
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3, viewName);
  for (const Wrong& wrong :
       {Wrong{"focal_lenght_px: 700\n", "focal_lenght_px"},
        Wrong{"focal_length_px: long\n", "focal_length_px"},
        Wrong{"focal_length_px: -1\nbaseline_m: 1\n", "focal_length_px"},
        Wrong{"focal_length_px: .nan\nbaseline_m: 1\n", "focal_length_px"},
        Wrong{"focal_length_px: [1, 2]\nbaseline_m: 1\n", "focal_length_px"},
        Wrong{"focal_length_px: 700\n", "baseline_m"},
        Wrong{"focus_distance_m: 4\n", "focal_length_px"},
        Wrong{"principal_point_px: [1, 2]\n", "focal_length_px"},
        Wrong{"baseline_m: 0\n", "baseline_m"},
        Wrong{"baseline_m: {x: 1}\n", "baseline_m"},
        Wrong{"baseline_m: [0.1, -0.1]\n", "baseline_m"},
        Wrong{"baseline_m: [0.1, 0.1, 0.1]\n", "baseline_m"},
        Wrong{"baseline_m:\n", "baseline_m"},
        Wrong{"focal_length_px: 7\nbaseline_m: 1\nfocus_distance_m: -4\n", "focus_distance_m"},
        Wrong{"focal_length_px: 7\nbaseline_m: 1\nprincipal_point_px: [a, b]\n", "principal_point_px"},
        Wrong{"disparity_range: [2, 1]\n", "disparity_range"},
        Wrong{"disparity_range: 3\n", "disparity_range"},
        Wrong{"truth: absent.pfm\n", "absent.pfm"},
        Wrong{"row_order: sideways\n", "row_order"},
        Wrong{"column_order: [right]\n", "column_order"},
        Wrong{"first: [0]\n", "first"},
        Wrong{"first: [2147483647, 0]\n", "first"},
        Wrong{"first_index: -1\n", "first_index"},
        Wrong{"first_index: 1.5\n", "first_index"},
        Wrong{"reference: middle\n", "reference"},
        Wrong{"reference: [-2147483648, 0]\n", "reference"},
        Wrong{"views: []\n", "either"},
        Wrong{"truth: [a\n", "YAML"},
        Wrong{"? [a, b]\n: c\n", "[a, b]"}})
  {
    folder.write("light_field.yaml", views + wrong.description);
    EXPECT_TRUE(says(readingError(folder.path()), {"light_field.yaml", wrong.part})) << wrong.description;
  }
}

TEST(LightFieldYaml, SaysWhereTheViewsAreMissing)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3, viewName);
  for (const auto& [description, part] :
       {std::make_pair("", "map"),
        std::make_pair("- a\n- b\n", "map"),
        std::make_pair("truth: a.pfm\n", "pattern"),
        std::make_pair("pattern: a_{row}_{column}.png\n", "grid"),
        std::make_pair("pattern: a_{row}_{column}.png\ngrid: {rows: 3, columns: 3}\n", "a_0_0.png"),
        std::make_pair("pattern: a_{row}.png\ngrid: {rows: 3, columns: 3}\n", "{column}"),
        std::make_pair("pattern: a_{row}_{colum}.png\ngrid: {rows: 3, columns: 3}\n", "{column}"),
        std::make_pair("pattern: a_{row}_{column:x}.png\ngrid: {rows: 3, columns: 3}\n", "{column}"),
        std::make_pair("pattern: [a]\ngrid: {rows: 3, columns: 3}\n", "pattern"),
        std::make_pair("pattern: a_{row}_{column}.png\ngrid: 3x3\n", "grid"),
        std::make_pair("pattern: a_{row}_{column}.png\ngrid: {rows: 3}\n", "columns"),
        std::make_pair("pattern: a_{row}_{column}.png\ngrid: {rows: 3, columns: 100000}\n", "columns"),
        std::make_pair("pattern: a_{row}_{column}.png\ngrid: {rows: 3, columns: 3, depth: 3}\n", "depth"),
        std::make_pair("views: 5\n", "list"),
        std::make_pair("views: [5]\n", "views[0]"),
        std::make_pair("views: [{row: 0, column: 0}]\n", "file"),
        std::make_pair("views: [{row: 0, column: 0, file: absent.png}]\n", "absent.png"),
        std::make_pair("views: [{row: a, column: 0, file: view_00_00.png}]\n", "row"),
        std::make_pair("views: [{row: 2000000000, column: 0, file: view_00_00.png}]\n", "2000000000"),
        std::make_pair("views: [{row: -2147483648, column: 0, file: view_00_00.png}]\n", "counted up to"),
        std::make_pair("views: [{row: 0, column: 0, file: view_00_00.png, colour: red}]\n", "colour"),
        std::make_pair("views: [{row: 0, column: 0, file: view_00_00.png, position_m: [0, 0]},"
                       " {row: 0, column: 1, file: view_00_01.png}]\n",
                       "view_00_01.png"),
        std::make_pair("views: [{row: 0, column: 0, file: view_00_00.png, position_m: [0, 0]},"
                       " {row: 0, column: 1, file: view_00_01.png, position_m: [20, 0]}]\nbaseline_m: 0.02\n",
                       "baseline_m")})
  {
    folder.write("light_field.yaml", description);
    EXPECT_TRUE(says(readingError(folder.path()), {part})) << description;
  }
}

}  // namespace
}  // namespace light_field_depth
