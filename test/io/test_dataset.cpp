// Folders whose files tell the place of each view by their names.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "dataset_files.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::expectSteps;
using testing::hciName;
using testing::readingError;
using testing::says;
using testing::TemporaryFolder;
using testing::twoDigits;
using testing::writeGrid;
using testing::writeView;

TEST(Dataset, ReadsAnHciFolderWithItsCalibration)
{
  const TemporaryFolder folder;
  writeGrid(folder, 9, 9, [](int row, int column) { return hciName(row, column); });
  writeView(folder, "mask_planes_lowres.png", 255);
  folder.write("parameters.cfg",
               "[intrinsics]\nfocal_length_mm = 100.0\nsensor_size_mm = 35.0\nfstop = 100\n\n[extrinsics]\n"
               "num_cams_x = 9\nnum_cams_y = 9\nbaseline_mm = 25.0\nfocus_distance_m = 4.25\n\n"
               "[meta]\n# of the scene\nscene = cotton\ndisp_min = -1.6\ndisp_max = 1.5\n");
  folder.write("gt_disp_lowres.pfm", "Pf\n1 1\n-1\n0000");
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "hci");
  EXPECT_EQ(dataset.light_field.views.size(), 81U);
  EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{4, 4}));
  expectSteps(dataset.light_field, 9, 9,
              [](int row, int column) { return cv::Point2d(column - 4, row - 4); });
  ASSERT_TRUE(dataset.light_field.calibration);
  const Calibration& calibration = *dataset.light_field.calibration;
  const double focal_length_px = 100.0 * testing::TEST_WIDTH_PX / 35.0;
  EXPECT_NEAR(calibration.focal_length_px, focal_length_px, 1e-9);
  EXPECT_NEAR(calibration.baseline_m, 0.025, 1e-12);
  EXPECT_NEAR(calibration.disparity_offset_px, focal_length_px * 0.025 / 4.25, 1e-9);
  EXPECT_EQ(calibration.principal_point_px, cv::Point2d(11.5, 8.5));
  ASSERT_TRUE(dataset.disparity_range);
  EXPECT_FLOAT_EQ(dataset.disparity_range->min, -1.6F);
  EXPECT_FLOAT_EQ(dataset.disparity_range->max, 1.5F);
  ASSERT_TRUE(dataset.truth);
  EXPECT_EQ(dataset.truth->filename(), "gt_disp_lowres.pfm");
}

TEST(Dataset, KeepsTheFilesInTheOrderOfTheViews)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 4,
            [](int row, int column) { return twoDigits(row) + "_" + twoDigits(column) + ".png"; });
  for (const Flip flip : {Flip::None, Flip::Rows, Flip::Columns, Flip::Both})
  {
    DatasetOptions options;
    options.flip = flip;
    const Dataset dataset = readDataset(folder.path(), options);
    ASSERT_EQ(dataset.files.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i)
    {
      const cv::Mat file = cv::imread(dataset.files[i].string(), cv::IMREAD_UNCHANGED);
      EXPECT_EQ(cv::norm(file, dataset.light_field.views[i].image, cv::NORM_INF), 0.0) << toString(flip) << i;
    }
  }
}

TEST(Dataset, AllowsMissingViewsInAnHciFolder)
{
  const TemporaryFolder folder;
  writeGrid(folder, 9, 9,
            [](int row, int column)
            { return row >= 2 && (row == 4 || column == 4) && column != 8 ? hciName(row, column) : ""; });
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.light_field.views.size(), 14U);
  EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{4, 4})) << "the centre of the whole grid";
  EXPECT_FALSE(dataset.light_field.calibration);
  EXPECT_FALSE(dataset.disparity_range);
}

TEST(Dataset, TakesTheSizeOfAnHciGridFromItsParameters)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 5, [](int row, int column) { return hciName(row, column, 5); });
  folder.write("parameters.cfg", "[extrinsics]\nnum_cams_x = 5\nnum_cams_y = 3\n");
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{1, 2}));
  expectSteps(dataset.light_field, 3, 5,
              [](int row, int column) { return cv::Point2d(column - 2, row - 1); });
}

TEST(Dataset, ReadsRowsAndColumnsInEveryFormOfName)
{
  struct Form
  {
    std::string prefix;
    std::string between;
    int first;
    std::string extension;
  };
  for (const Form& form :
       {Form{"2067_", "_", 1, ".png"}, Form{"", "_", 0, ".jpg"}, Form{"", "", 1, ".bmp"},
        Form{"", "", 0, ".tiff"}, Form{"view ", "_", 0, ".TIF"}, Form{"a_b-", "_", 1, ".jpeg"}})
  {
    const TemporaryFolder folder;
    writeGrid(folder, 3, 3,
              [&](int row, int column)
              {
                return form.prefix + twoDigits(row + form.first) + form.between +
                       twoDigits(column + form.first) + form.extension;
              });
    folder.write("notes.txt", "anything");
    writeView(folder, "thumbnail.png", 99);
    const Dataset dataset = readDataset(folder.path());
    EXPECT_EQ(dataset.format, "grid");
    EXPECT_EQ(dataset.light_field.views.size(), 9U);
    EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{1 + form.first, 1 + form.first}));
    expectSteps(dataset.light_field, 3, 3,
                [](int row, int column) { return cv::Point2d(column - 1, row - 1); });
  }
}

TEST(Dataset, ReadsNumbersBelowZero)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 3,
            [](int row, int column)
            { return "view_" + twoDigits(row) + "_" + std::to_string(column - 1) + ".png"; });
  const LightField light_field = readDataset(folder.path()).light_field;
  ASSERT_EQ(light_field.views.size(), 9U);
  EXPECT_EQ(light_field.reference().grid, (GridPosition{1, 0}));
  EXPECT_EQ(cv::mean(light_field.reference().image)[0], testing::levelOf(1, 1));
  expectSteps(light_field, 3, 3, [](int row, int column) { return cv::Point2d(column - 1, row - 1); });
}

TEST(Dataset, CountsStepsOfTheNumberingAlsoAcrossGaps)
{
  const TemporaryFolder folder;
  for (const int row : {0, 4, 8})
  {
    for (const int column : {0, 4, 8})
    {
      writeView(folder, twoDigits(row) + "_" + twoDigits(column) + ".png", testing::levelOf(row, column));
    }
  }
  const LightField light_field = readDataset(folder.path()).light_field;
  EXPECT_EQ(light_field.reference().grid, (GridPosition{4, 4}));
  EXPECT_EQ(light_field.views.front().steps, cv::Point2d(-4, -4));
  EXPECT_EQ(light_field.views.back().steps, cv::Point2d(4, 4));
}

TEST(Dataset, FlipsWhatIsNumberedAgainstTheConvention)
{
  const TemporaryFolder folder;
  writeGrid(folder, 3, 5,
            [](int row, int column) { return twoDigits(row + 1) + twoDigits(column + 1) + ".png"; });
  for (const auto& [flip, sign_x, sign_y] :
       {std::make_tuple(Flip::None, 1, 1), std::make_tuple(Flip::Rows, 1, -1),
        std::make_tuple(Flip::Columns, -1, 1), std::make_tuple(Flip::Both, -1, -1)})
  {
    DatasetOptions options;
    options.flip = flip;
    options.reference = GridPosition{1, 2};
    const Dataset dataset = readDataset(folder.path(), options);
    EXPECT_EQ(dataset.flip, flip);
    EXPECT_EQ(cv::mean(dataset.light_field.reference().image)[0], testing::levelOf(0, 1))
        << "the reference is numbered as in the files";
    const int x = sign_x;
    const int y = sign_y;
    expectSteps(dataset.light_field, 3, 5,
                [&](int row, int column) { return cv::Point2d(x * (column - 1), y * row); });
    for (const View& view : dataset.light_field.views)
    {
      const GridPosition& centre = dataset.light_field.reference().grid;
      EXPECT_EQ(view.steps, cv::Point2d(view.grid.column - centre.column, view.grid.row - centre.row));
    }
  }
}

TEST(Dataset, TakesStanfordPositionsAsSteps)
{
  const TemporaryFolder folder;
  // x falls with the column and y with the row, as on the gantry; the first column stands off its place.
  writeGrid(folder, 3, 3,
            [](int row, int column)
            {
              const double x = 1000.5 - 8.0 * column + (column == 0 ? 0.75 : 0.0);
              const double y = -400.25 - 8.0 * row;
              return "out_" + twoDigits(row) + "_" + twoDigits(column) + "_" + std::to_string(y) + "_" +
                     std::to_string(x) + ".png";
            });
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "stanford");
  EXPECT_EQ(dataset.flip, Flip::Both);
  const double step = 8.0 + 0.375;
  expectSteps(dataset.light_field, 3, 3,
              [&](int row, int column) {
                return cv::Point2d((8.0 * (1 - column) + (column == 0 ? 0.75 : 0.0)) / step,
                                   8.0 * (1 - row) / step);
              });
  DatasetOptions unflipped;
  unflipped.flip = Flip::None;
  EXPECT_GT(testing::viewOf(readDataset(folder.path(), unflipped).light_field, 1, 2)->steps.x, 0.9);
}

TEST(Dataset, KeepsEightAndSixteenBitsGreyAndColour)
{
  for (const auto& [written, read] : {std::make_pair(CV_8UC1, CV_8UC1), std::make_pair(CV_8UC3, CV_8UC3),
                                      std::make_pair(CV_16UC1, CV_16UC1), std::make_pair(CV_16UC3, CV_16UC3),
                                      std::make_pair(CV_8UC4, CV_8UC3), std::make_pair(CV_16UC4, CV_16UC3)})
  {
    for (const std::string extension : {".png", ".tiff"})
    {
      const TemporaryFolder folder;
      for (const int column : {0, 1, 2})
      {
        const int level = CV_MAT_DEPTH(written) == CV_16U ? 40000 : 200;
        writeView(folder, "00_" + twoDigits(column) + extension, level + column, written);
      }
      const LightField light_field = readDataset(folder.path()).light_field;
      EXPECT_EQ(light_field.reference().image.type(), read) << written << extension;
      EXPECT_EQ(cv::mean(light_field.views[2].image)[0], CV_MAT_DEPTH(written) == CV_16U ? 40002 : 202);
    }
  }
}

TEST(Dataset, DropsTheTruthOfAnotherReferenceAndTheRangeOfAnotherFlip)
{
  const TemporaryFolder folder;
  writeGrid(folder, 9, 9, [](int row, int column) { return hciName(row, column); });
  folder.write("parameters.cfg",
               "[intrinsics]\nfocal_length_mm = 70\nsensor_size_mm = 35\n[extrinsics]\nbaseline_mm = 10\n"
               "focus_distance_m = 2\n[meta]\ndisp_min = -1\ndisp_max = 2\n");
  folder.write("gt_disp_lowres.pfm", "Pf\n1 1\n-1\n0000");
  DatasetOptions options;
  options.reference = GridPosition{3, 6};
  const Dataset dataset = readDataset(folder.path(), options);
  EXPECT_FALSE(dataset.truth);
  EXPECT_TRUE(dataset.disparity_range);
  const Calibration& calibration = *dataset.light_field.calibration;
  EXPECT_NEAR(calibration.principal_point_px.x, 11.5 + 2 * calibration.disparity_offset_px, 1e-9)
      << "the principal point of a sheared light field moves with the view";
  EXPECT_NEAR(calibration.principal_point_px.y, 8.5 - calibration.disparity_offset_px, 1e-9);
  options = {};
  options.flip = Flip::Both;
  EXPECT_FALSE(readDataset(folder.path(), options).disparity_range);
  EXPECT_FALSE(readDataset(folder.path(), options).truth);
}

/// A broken view that is not chosen does no harm: it is not decoded.
TEST(Dataset, DecodesOnlyTheViewsThatAreChosen)
{
  const TemporaryFolder folder;
  writeGrid(folder, 5, 5,
            [](int row, int column) { return twoDigits(row) + "_" + twoDigits(column) + ".png"; });
  folder.write("00_00.png", "no image");
  DatasetOptions options;
  options.order = Order::RowMajor;
  options.flip = Flip::None;
  EXPECT_TRUE(says(readingError(folder.path(), options), {"00_00.png"}));
  options.selection = [](const LightField&) { return ViewSelection::Cross; };
  const Dataset dataset = readDataset(folder.path(), options);
  EXPECT_EQ(dataset.views_found, 25U);
  ASSERT_EQ(dataset.light_field.views.size(), 9U);
  EXPECT_EQ(dataset.files.front().filename(), "00_02.png");
  EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{2, 2}));
}

TEST(Dataset, ReadsTheSameOnAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  writeGrid(folder, 5, 5,
            [](int row, int column) { return twoDigits(row) + "_" + twoDigits(column) + ".png"; });
  for (const int threads : {1, 2, 7})
  {
    DatasetOptions options;
    options.threads = threads;
    expectSteps(readDataset(folder.path(), options).light_field, 5, 5,
                [](int row, int column) { return cv::Point2d(column - 2, row - 2); });
  }
}

TEST(WrongDataset, SaysWhatIsWrongWithTheFolder)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(says(readingError(folder / "absent"), {"absent", "does not exist"}));
  EXPECT_TRUE(says(readingError(folder.path()), {"no images", folder.path().c_str()}));
  EXPECT_TRUE(says(readingError(folder.write("file.txt", "text")), {"file.txt", "not a folder"}));
  writeView(folder, "holiday.png", 7);
  EXPECT_TRUE(says(readingError(folder.path()), {"holiday.png", "light_field.yaml"}));
  writeView(folder, "00_00.png", 7);
  EXPECT_TRUE(says(readingError(folder.path()), {"1 view(s)", "two"}));
  writeView(folder, "00_01.png", 7);
  EXPECT_EQ(readingError(folder.path()), "");
  writeView(folder, "input_Cam000.png", 7);
  EXPECT_TRUE(says(readingError(folder.path()), {"mixes", "00_00.png", "input_Cam000.png"}));
}

TEST(WrongDataset, RefusesTwoPrefixesAndTwoFilesOfOnePlace)
{
  const TemporaryFolder folder;
  writeView(folder, "a_00_00.png", 7);
  writeView(folder, "a_00_01.png", 7);
  writeView(folder, "b_00_00.png", 7);
  EXPECT_TRUE(says(readingError(folder.path()), {"mixes", "a_00_00.png", "b_00_00.png"}));
  std::filesystem::rename(folder / "b_00_00.png", folder / "a_00_00.bmp");
  EXPECT_TRUE(says(readingError(folder.path()), {"(0, 0)", "a_00_00.png", "a_00_00.bmp"}));
}

TEST(WrongDataset, RefusesImagesThatDiffer)
{
  const TemporaryFolder folder;
  writeView(folder, "00_00.png", 7);
  writeView(folder, "00_01.png", 7, CV_16UC3);
  EXPECT_TRUE(says(readingError(folder.path()), {"00_00.png", "00_01.png", "8 bits", "16 bits"}));
  writeView(folder, "00_01.png", 7, CV_16UC1);
  EXPECT_TRUE(says(readingError(folder.path()), {"8 bits", "16 bits"}));
  ASSERT_TRUE(cv::imwrite((folder / "00_01.png").string(), cv::Mat::zeros(30, 40, CV_8UC1)));
  EXPECT_TRUE(says(readingError(folder.path()), {"24 x 18", "40 x 30"}));
}

/// A picture with detail, so that its file is large and a cut hits the pixels.
cv::Mat detailedImage()
{
  cv::Mat image(64, 64, CV_8UC3);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  return image;
}

TEST(WrongDataset, RefusesTruncatedAndDamagedImages)
{
  for (const std::string extension : {".png", ".jpg", ".tiff", ".bmp"})
  {
    const TemporaryFolder folder;
    for (const char* const name : {"00_00", "00_01", "00_02"})
    {
      ASSERT_TRUE(cv::imwrite((folder / (name + extension)).string(), detailedImage()));
    }
    const std::string broken = "00_01" + extension;
    const auto size = std::filesystem::file_size(folder / broken);
    ASSERT_EQ(readingError(folder.path()), "") << extension;
    for (const double part : {0.95, 0.5, 0.1, 0.0})
    {
      std::filesystem::resize_file(folder / broken,
                                   static_cast<std::uintmax_t>(part * static_cast<double>(size)));
      EXPECT_TRUE(says(readingError(folder.path()), {broken.c_str()})) << extension << " " << part;
    }
    folder.write(broken, "this is no image at all");
    EXPECT_TRUE(says(readingError(folder.path()), {broken.c_str(), "decoded"})) << extension;
  }
}

TEST(WrongDataset, RefusesAReferenceThatIsNotThere)
{
  const TemporaryFolder folder;
  writeGrid(folder, 2, 2,
            [](int row, int column) { return twoDigits(row) + "_" + twoDigits(column) + ".png"; });
  DatasetOptions options;
  options.reference = GridPosition{5, 1};
  EXPECT_TRUE(says(readingError(folder.path(), options), {"(5, 1)", "(0, 0)", "(1, 1)"}));
  EXPECT_THROW(flipFromString("sideways"), InputError);
  EXPECT_EQ(flipFromString("both"), Flip::Both);
}

TEST(WrongDataset, RefusesBrokenHciParameters)
{
  const TemporaryFolder folder;
  writeGrid(folder, 9, 9, [](int row, int column) { return row == 4 ? hciName(row, column) : ""; });
  for (const auto& [content, part] :
       {std::make_pair("[extrinsics]\nbaseline_mm = wide\n", "baseline_mm"),
        std::make_pair("[extrinsics]\nbaseline_mm = -3\n", "baseline_mm"),
        std::make_pair("[extrinsics]\nfocus_distance_m = 0\n", "focus_distance_m"),
        std::make_pair("[extrinsics]\nnum_cams_x = 9.5\n", "num_cams_x"),
        std::make_pair("[extrinsics]\nnum_cams_x = 100000000\n", "num_cams_x"),
        std::make_pair("[extrinsics]\nnum_cams_y = nan\n", "num_cams_y"),
        std::make_pair("[extrinsics\nnum_cams_y = 9\n", "line"),
        std::make_pair("[extrinsics]\nnum_cams_x = 3\nnum_cams_y = 3\n", "input_Cam036.png")})
  {
    folder.write("parameters.cfg", content);
    EXPECT_TRUE(says(readingError(folder.path()), {"parameters.cfg", part})) << content;
  }
}

TEST(WrongDataset, RefusesPositionsThatMakeNoGrid)
{
  const TemporaryFolder folder;
  writeGrid(folder, 2, 2,
            [](int row, int column)
            { return "out_0" + std::to_string(row) + "_0" + std::to_string(column) + "_1.5_2.5.png"; });
  EXPECT_TRUE(says(readingError(folder.path()), {"positions", folder.path().c_str()}));
}

}  // namespace
}  // namespace light_field_depth
