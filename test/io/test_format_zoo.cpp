// One folder for each way in which people have light fields: every one opens with the right order, grid,
// calibration and pixels, without an option.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::both;
using testing::extraImage;
using testing::FIVE;
using testing::grid;
using testing::lenslets;
using testing::NameOf;
using testing::NINE;
using testing::padded;
using testing::PAIR;
using testing::RenderedScene;
using testing::ROW;
using testing::Scene;
using testing::SIDE;
using testing::TemporaryFolder;
using testing::text;
using testing::viewAt;
using testing::Write;
using testing::write;

struct Animal
{
  std::string name;
  cv::Size grid;
  std::string format;
  Write write;
  double max_difference = 0.0;  ///< of a level, in the mean: what JPEG may change
};

std::string position(double value)
{
  return std::to_string(value);
}

std::vector<Animal> namedByRowAndColumn()
{
  const auto named = [](const std::string& name, const NameOf& name_of) {
    return Animal{name, FIVE, "grid", grid(FIVE, name_of)};
  };
  return {
      named("RR_CC", [](int r, int c) { return padded(r, 2) + "_" + padded(c, 2) + ".png"; }),
      named("view_0_0_rgb",
            [](int r, int c) { return "view_" + padded(r, 1) + "_" + padded(c, 1) + "_rgb.png"; }),
      named("0-0", [](int r, int c) { return padded(r, 1) + "-" + padded(c, 1) + ".png"; }),
      named("negative numbers",
            [](int r, int c) { return "view_" + padded(r - 2, 2) + "_" + padded(c - 2, 2) + ".png"; }),
      named("columns from 998",
            [](int r, int c) { return padded(r, 2) + "_" + padded(c + 998, 2) + ".png"; }),
      named("RRCC from 1", [](int r, int c) { return padded(r + 1, 2) + padded(c + 1, 2) + ".png"; }),
      named("index and place",
            [](int r, int c)
            {
              const int serpentine = r * SIDE + (r % 2 == 0 ? c : SIDE - 1 - c) + 1;
              return "IMG_0001_" + padded(serpentine, 3) + "_" + padded(r + 1, 2) + "_" + padded(c + 1, 2) +
                     ".png";
            }),
      named("upper case", [](int r, int c) { return "VIEW_" + padded(r, 2) + "_" + padded(c, 2) + ".PNG"; }),
      named("cam0101 in full", [](int r, int c) { return "cam" + padded(r, 2) + padded(c, 2) + ".png"; }),
      named("an exposure beside them",
            [](int r, int c) {
              return "cam_" + padded(r, 1) + "_" + padded(c, 1) + "_exp" + padded(1000 + 13 * r, 4) + ".png";
            }),
      {"param.txt beside them", FIVE, "grid",
       both(grid(FIVE, [](int r, int c) { return padded(r, 2) + "_" + padded(c, 2) + ".png"; }),
            text("param.txt", "num_x 5\nnum_y 5\nbase_x 0.1\nbase_y 0.1\n"))},
      named("letters for rows", [](int r, int c)
            { return std::string("cam_") + static_cast<char>('A' + r) + padded(c + 1, 1) + ".png"; }),
      named("spaces and letters beyond ASCII", [](int r, int c)
            { return "B\u00FCste \u82B1 (" + padded(r, 1) + ", " + padded(c, 1) + ").png"; }),
      named("thumbnails, masks and truth beside it",
            [](int r, int c) { return "lf_" + padded(r, 2) + "_" + padded(c, 2) + ".png"; }),
  };
}

std::vector<Animal> namedByIndex()
{
  const auto index = [](int r, int c) { return r * SIDE + c; };
  return {
      {"HCI", FIVE, "hci",
       both(grid(FIVE, [=](int r, int c) { return "input_Cam" + padded(index(r, c), 3) + ".png"; }),
            text("parameters.cfg", "\xEF\xBB\xBF[extrinsics]\nnum_cams_x = 5\nnum_cams_y = 5\n"))},
      {"HCI, 5 x 5 without parameters", FIVE, "hci",
       grid(FIVE, [=](int r, int c) { return "input_Cam" + padded(index(r, c), 3) + ".png"; })},
      {"HCI, counted from 1", FIVE, "hci",
       grid(FIVE, [=](int r, int c) { return "input_Cam" + padded(index(r, c) + 1, 3) + ".png"; })},
      {"0.png", FIVE, "index", grid(FIVE, [=](int r, int c) { return padded(index(r, c), 1) + ".png"; })},
      {"0001.png", FIVE, "index",
       grid(FIVE, [=](int r, int c) { return padded(index(r, c) + 1, 4) + ".png"; })},
      {"lowtoys001.bmp", FIVE, "index",
       grid(FIVE, [=](int r, int c) { return "lowtoys" + padded(index(r, c) + 1, 3) + ".bmp"; })},
      {"a date before it", FIVE, "index",
       grid(FIVE, [=](int r, int c) { return "2024-05-01_12-00-00_" + padded(index(r, c), 2) + ".png"; })},
      {"a stamp behind it", FIVE, "index",
       grid(FIVE,
            [=](int r, int c) {
              return "cam" + padded(index(r, c), 2) + "_" + padded(1699999000 + 40 * index(r, c), 10) +
                     ".png";
            })},
      {"back and forth", FIVE, "index",
       grid(FIVE, [=](int r, int c)
            { return "IMG_" + padded(index(r, r % 2 == 0 ? c : SIDE - 1 - c), 4) + ".png"; })},
      {"nine in a row", NINE, "index", grid(NINE, [](int, int c) { return "cam" + padded(c, 2) + ".png"; })},
      {"nine folders in a row", NINE, "index of folders",
       grid(NINE, [](int, int c) { return "camera " + padded(c + 1, 1) + "/frame_000123.png"; })},
      {"frames and views in the names", FIVE, "index",
       both(grid(FIVE, [=](int r, int c) { return "Painter_pr_00001_" + padded(index(r, c), 2) + ".png"; }),
            grid(FIVE, [=](int r, int c) { return "Painter_pr_00002_" + padded(index(r, c), 2) + ".png"; }))},
      {"frame, row and column in the names", FIVE, "grid",
       both(grid(FIVE, [](int r, int c) { return "000_" + padded(r, 2) + "_" + padded(c, 2) + ".png"; }),
            grid(FIVE, [](int r, int c) { return "001_" + padded(r, 2) + "_" + padded(c, 2) + ".png"; }))},
      {"cameras and frames in the names", ROW, "index",
       both(grid(ROW, [](int, int c) { return "cam" + padded(c, 1) + "_frame0001.png"; }),
            grid(ROW, [](int, int c) { return "cam" + padded(c, 1) + "_frame0002.png"; }))},
      {"a folder for each row", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return "row_" + padded(r, 1) + "/col_" + padded(c, 1) + ".png"; })},
      {"a folder for each row, in numbers", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return padded(r, 2) + "/" + padded(c, 2) + ".png"; })},
      {"a folder in a folder", FIVE, "grid",
       grid(FIVE,
            [](int r, int c) { return "Scene/images/views/" + padded(r, 1) + "_" + padded(c, 1) + ".png"; })},
      {"a row of letters", ROW, "index",
       grid(ROW, [](int, int c) { return std::string("cam") + static_cast<char>('A' + c) + ".png"; })},
      {"a row", ROW, "index", grid(ROW, [](int, int c) { return "view" + padded(c, 1) + ".png"; })},
      {"a folder for each camera", FIVE, "index of folders",
       grid(FIVE, [=](int r, int c) { return "cam_" + padded(index(r, c), 2) + "/image_000.JPG"; }), 5.0},
      {"cameras in two digits", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return "cam_" + padded(r, 1) + padded(c, 1) + "/img.png"; })},
      {"cameras named by row and column", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return "cam_" + padded(r, 2) + "_" + padded(c, 2) + "/0001.png"; })},
      {"a folder for each frame, in numbers, of views with an index", FIVE, "index",
       both(grid(FIVE, [=](int r, int c) { return "0000/" + padded(index(r, c), 3) + ".png"; }),
            grid(FIVE, [=](int r, int c) { return "0001/" + padded(index(r, c), 3) + ".png"; }))},
      {"a folder for each frame", FIVE, "grid",
       both(
           grid(FIVE, [](int r, int c) { return "frame_001/" + padded(r, 2) + "_" + padded(c, 2) + ".png"; }),
           extraImage("frame_002/00_00.png"))},
  };
}

std::vector<Animal> namedByPosition()
{
  return {
      {"Stanford", FIVE, "stanford",
       grid(FIVE,
            [](int r, int c)
            {
              return "out_" + padded(SIDE - 1 - r, 2) + "_" + padded(SIDE - 1 - c, 2) + "_" +
                     position(-780.1 + 8.0 * r) + "_" + position(-3355.3 + 8.0 * c) + "_.png";
            })},
      {"Blender", FIVE, "blender",
       grid(FIVE,
            [](int r, int c)
            {
              return "Original Camera_" + padded(SIDE - 1 - r, 2) + "_" + padded(SIDE - 1 - c, 2) + "_" +
                     position(30.75 * (r - 2)) + "_" + position(30.75 * (c - 2)) + "_30_36.png";
            })},
  };
}

std::vector<Animal> pairs()
{
  const std::string calib =
      "cam0=[100 0 41; 0 100 31.5; 0 0 1]\ncam1=[100 0 43.5; 0 100 31.5; 0 0 1]\ndoffs=2.5\nbaseline=200\n"
      "width=80\nheight=64\nndisp=12\n";
  const auto pair = [](const std::string& left, const std::string& right)
  { return grid(PAIR, [=](int, int c) { return c == 0 ? left : right; }); };
  return {
      {"Middlebury", PAIR, "middlebury", both(pair("im0.png", "im1.png"), text("calib.txt", calib))},
      {"view1 and view5", PAIR, "index", both(pair("view1.png", "view5.png"), extraImage("disp1.png"))},
      {"left and right", PAIR, "stereo", pair("left.png", "right.png")},
      {"L and R", PAIR, "stereo", pair("scene_L.png", "scene_R.png")},
      {"A and B", PAIR, "stereo", pair("camA.png", "camB.png")},
      {"imgL and imgR", PAIR, "stereo", pair("imgL.png", "imgR.png")},
      {"leftImage and rightImage", PAIR, "stereo", pair("leftImage.png", "rightImage.png")},
      {"KITTI", PAIR, "kitti",
       both(pair("image_2/000000_10.png", "image_3/000000_10.png"),
            both(pair("image_2/000000_11.png", "image_3/000000_11.png"),
                 both(pair("image_2/000001_10.png", "image_3/000001_10.png"),
                      extraImage("disp_occ_0/000000_10.png"))))},
      {"KITTI, raw", PAIR, "kitti", pair("image_02/data/0000000000.png", "image_03/data/0000000000.png")},
      {"EuRoC", PAIR, "index of folders",
       pair("mav0/cam0/data/1403636579763555584.png", "mav0/cam1/data/1403636579763555584.png")},
      {"left and right folders", PAIR, "stereo of folders", pair("left/0001.png", "right/0001.png")},
  };
}

/// The views of the scene beside each other in one image.
cv::Mat tiling(const Scene& scene)
{
  const cv::Size size = scene(0, 0).size();
  cv::Mat image(size.height * SIDE, size.width * SIDE, CV_8UC3);
  for (int row = 0; row < SIDE; ++row)
  {
    for (int column = 0; column < SIDE; ++column)
    {
      scene(row, column).copyTo(image(cv::Rect({column * size.width, row * size.height}, size)));
    }
  }
  return image;
}

std::vector<Animal> namedByPlaceWords()
{
  const auto words = [](std::vector<std::string> rows, std::vector<std::string> columns)
  {
    const cv::Size size(static_cast<int>(columns.size()), static_cast<int>(rows.size()));
    return grid(
        size, [=](int r, int c)
        { return rows[static_cast<std::size_t>(r)] + columns[static_cast<std::size_t>(c)] + ".png"; });
  };
  const cv::Size three(3, 1);
  const cv::Size column(1, 2);
  return {
      {"left, center and right", three, "place words", words({"cam_"}, {"left", "center", "right"})},
      {"left, middle and right", three, "place words", words({""}, {"left", "middle", "right"})},
      {"l, c and r", three, "place words", words({"scene1_"}, {"l", "c", "r"})},
      {"L, M and R of two frames", three, "place words",
       both(words({"0001_"}, {"L", "M", "R"}), words({"0002_"}, {"L", "M", "R"}))},
      {"folders left, center and right", three, "place words of folders",
       words({""}, {"left/0001", "center/0001", "right/0001"})},
      {"top and bottom", column, "stereo", words({"top", "bottom"}, {"_rgb"})},
      {"top and bottom, left and right",
       {2, 2},
       "place words",
       words({"top_", "bottom_"}, {"left", "right"})},
      {"nw to se", {2, 2}, "place words", words({"n", "s"}, {"w", "e"})},
  };
}

/// All views of a row from the bottom left on.
cv::Mat quilt(const Scene& scene)
{
  const cv::Size size = scene(0, 0).size();
  cv::Mat image(3 * size.height, 3 * size.width, CV_8UC3);
  for (int view = 0; view < NINE.width; ++view)
  {
    scene(0, view).copyTo(image(cv::Rect({view % 3 * size.width, (2 - view / 3) * size.height}, size)));
  }
  return image;
}

std::vector<Animal> singleImages()
{
  return {
      {"quilt", NINE, "quilt",
       [](const TemporaryFolder& folder, const Scene& scene)
       { write(folder, "bust_qs3x3a1.25.png", quilt(scene)); }},
      {"lenslets", FIVE, "lenslets",
       [](const TemporaryFolder& folder, const Scene& scene)
       { write(folder, "flower_eslf.png", lenslets(scene)); }},
      {"tiles", FIVE, "tiles",
       [](const TemporaryFolder& folder, const Scene& scene) { write(folder, "table.png", tiling(scene)); }},
      {"tiles in a light_field.yaml", FIVE, "yaml",
       both([](const TemporaryFolder& folder, const Scene& scene)
            { write(folder, "table.png", tiling(scene)); },
            text("light_field.yaml", "image: table.png\ntiles: {rows: 5, columns: 5}\n"))},
  };
}

std::vector<Animal> allAnimals()
{
  std::vector<Animal> animals;
  for (const auto& some : {namedByRowAndColumn(), namedByIndex(), namedByPosition(), pairs(),
                           namedByPlaceWords(), singleImages()})
  {
    animals.insert(animals.end(), some.begin(), some.end());
  }
  return animals;
}

TEST(FormatZoo, EveryFolderOpensWithoutAnOption)
{
  for (const Animal& animal : allAnimals())
  {
    SCOPED_TRACE(animal.name);
    const TemporaryFolder folder;
    animal.write(folder, RenderedScene::view);
    if (animal.name.rfind("thumbnails", 0) == 0)
    {
      for (const char* const name :
           {"thumbnail.png", "mask_01.png", "gt_disp_00_00.png", "lf_00_00_depth.png"})
      {
        write(folder, name, cv::Mat(16, 20, CV_8UC1, 7.0));
      }
    }
    Dataset dataset;
    ASSERT_NO_THROW(dataset = readDataset(folder.path()))
        << testing::messageOf<InputError>([&] { readDataset(folder.path()); });
    EXPECT_EQ(dataset.format, animal.format);
    ASSERT_EQ(dataset.light_field.views.size(), static_cast<std::size_t>(animal.grid.area()));
    const cv::Point middle((animal.grid.width - 1) / 2, (animal.grid.height - 1) / 2);
    for (int row = 0; row < animal.grid.height; ++row)
    {
      for (int column = 0; column < animal.grid.width; ++column)
      {
        const View* const view = viewAt(dataset.light_field, column - middle.x, row - middle.y);
        ASSERT_TRUE(view != nullptr) << row << " " << column;
        EXPECT_LE(cv::norm(view->image, RenderedScene::view(row, column), cv::NORM_L1) / (3.0 * 80.0 * 64.0),
                  animal.max_difference)
            << row << " " << column;
      }
    }
  }
}

TEST(FormatZoo, SaysWhatWasLeftOutAndWhichFrameIsRead)
{
  const TemporaryFolder folder;
  grid(PAIR, [](int, int c) { return "a_00_" + padded(c, 2) + ".png"; })(folder, RenderedScene::view);
  EXPECT_TRUE(readDataset(folder.path()).notes.empty());
  write(folder, "thumbnail.png", cv::Mat(16, 20, CV_8UC1, 7.0));
  write(folder, "a_00_00_mask.png", cv::Mat(16, 20, CV_8UC1, 7.0));
  const Dataset dataset = readDataset(folder.path());
  ASSERT_EQ(dataset.notes.size(), 1U);
  EXPECT_NE(dataset.notes.front().find("1 more are left out"), std::string::npos) << dataset.notes.front();
}

TEST(FormatZoo, PointsOfTheCompassMakeACross)
{
  const TemporaryFolder folder;
  for (const auto& [name, row, column] :
       {std::make_tuple("north", 1, 2), std::make_tuple("west", 2, 1), std::make_tuple("center", 2, 2),
        std::make_tuple("east", 2, 3), std::make_tuple("south", 3, 2)})
  {
    write(folder, std::string(name) + ".png", RenderedScene::view(row, column));
  }
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "place words");
  ASSERT_EQ(dataset.light_field.views.size(), 5U);
  EXPECT_EQ(dataset.light_field.reference_index, 2U);
  const View* const north = viewAt(dataset.light_field, 0.0, -1.0);
  ASSERT_TRUE(north != nullptr);
  EXPECT_EQ(cv::norm(north->image, RenderedScene::view(1, 2), cv::NORM_INF), 0.0);
}

TEST(FormatZoo, AnIndexWithViewsMissingIsLaidOutByTheImages)
{
  struct Missing
  {
    int first_number;
    std::vector<int> places;
  };
  for (const Missing& missing :
       {Missing{0, {0, 4, 20, 24}}, Missing{1, {0, 4, 20, 24}}, Missing{0, {0, 4, 20}},
        Missing{0, {4, 20, 24}}, Missing{0, {7}}, Missing{7, {0, 12, 13, 24}}})
  {
    SCOPED_TRACE(std::to_string(missing.first_number) + " " + std::to_string(missing.places.size()));
    const TemporaryFolder folder;
    for (int place = 0; place < SIDE * SIDE; ++place)
    {
      if (std::find(missing.places.begin(), missing.places.end(), place) == missing.places.end())
      {
        write(folder, padded(missing.first_number + place, missing.places.size() == 4 ? 4 : 3) + ".png",
              RenderedScene::view(place / SIDE, place % SIDE));
      }
    }
    const Dataset dataset = readDataset(folder.path());
    EXPECT_TRUE(dataset.warnings.empty());
    ASSERT_EQ(dataset.light_field.views.size(), SIDE * SIDE - missing.places.size());
    for (const View& view : dataset.light_field.views)
    {
      const int row = view.grid.row;
      const int column = view.grid.column;
      ASSERT_LT(std::max(row, column), SIDE);
      EXPECT_EQ(cv::norm(view.image, RenderedScene::view(row, column), cv::NORM_INF), 0.0)
          << row << " " << column;
    }
  }
}

TEST(FormatZoo, ARowWithAViewMissingIsARow)
{
  const TemporaryFolder folder;
  for (int column = 0; column < testing::LONG_ROW; ++column)
  {
    if (column != 3)
    {
      write(folder, padded(column, 2) + ".png", RenderedScene::view(2, column));
    }
  }
  const Dataset dataset = readDataset(folder.path());
  ASSERT_EQ(dataset.light_field.views.size(), 8U);
  EXPECT_EQ(dataset.light_field.views.back().grid, (GridPosition{0, 8}));
}

}  // namespace
}  // namespace light_field_depth
