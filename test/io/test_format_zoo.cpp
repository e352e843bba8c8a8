// One folder for each way in which people have light fields: every one opens with the right order, grid,
// calibration and pixels, without an option.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

constexpr int SIDE = 5;
constexpr int LONG_ROW = 9;

/// A view of the scene by its row and column from 0, in the package's convention.
using Scene = std::function<cv::Mat(int row, int column)>;

/// Writes a scene of `grid` views into a folder.
using Write = std::function<void(const TemporaryFolder& folder, const Scene& scene)>;

struct Animal
{
  std::string name;
  cv::Size grid;
  std::string format;
  Write write;
  double max_difference = 0.0;  ///< of a level, in the mean: what JPEG may change
};

/// A scene with depth, of 5 x 9 views, rendered once.
class RenderedScene
{
public:
  static cv::Mat view(int row, int column)
  {
    static const RenderedScene scene;
    const auto found = std::find_if(scene.views_.begin(), scene.views_.end(),
                                    [&](const View& view) {
                                      return view.grid == GridPosition{row, column};
                                    });
    return found->image;
  }

private:
  RenderedScene()
  {
    testing::SceneSettings settings;
    settings.size = {80, 64};
    settings.positions = testing::gridPositions(SIDE, LONG_ROW);
    settings.samples = 2;
    views_ = testing::renderScene(testing::standardScene(settings.size), settings).light_field.views;
  }

  std::vector<View> views_;
};

void write(const TemporaryFolder& folder, const std::string& name, const cv::Mat& image)
{
  std::filesystem::create_directories((folder / name).parent_path());
  ASSERT_TRUE(cv::imwrite((folder / name).string(), image)) << name;
}

std::string padded(int number, std::size_t digits)
{
  std::string text = std::to_string(std::abs(number));
  text = (text.size() < digits ? std::string(digits - text.size(), '0') : "") + text;
  return (number < 0 ? "-" : "") + text;
}

using NameOf = std::function<std::string(int row, int column)>;

/// All views of a grid, each in a file of its own.
Write grid(const cv::Size& size, const NameOf& name_of)
{
  return [=](const TemporaryFolder& folder, const Scene& scene)
  {
    for (int row = 0; row < size.height; ++row)
    {
      for (int column = 0; column < size.width; ++column)
      {
        write(folder, name_of(row, column), scene(row, column));
      }
    }
  };
}

Write both(const Write& first, const Write& second)
{
  return [=](const TemporaryFolder& folder, const Scene& scene)
  {
    first(folder, scene);
    second(folder, scene);
  };
}

Write text(const std::string& name, const std::string& content)
{
  return [=](const TemporaryFolder& folder, const Scene&) { folder.write(name, content); };
}

Write extraImage(const std::string& name)
{
  return [=](const TemporaryFolder& folder, const Scene&)
  { write(folder, name, cv::Mat(16, 20, CV_8UC1, 7.0)); };
}

const cv::Size FIVE(SIDE, SIDE);
const cv::Size ROW(SIDE, 1);
const cv::Size NINE(LONG_ROW, 1);
const cv::Size PAIR(2, 1);

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
      {"back and forth", FIVE, "index",
       grid(FIVE, [=](int r, int c)
            { return "IMG_" + padded(index(r, r % 2 == 0 ? c : SIDE - 1 - c), 4) + ".png"; })},
      {"nine in a row", NINE, "index", grid(NINE, [](int, int c) { return "cam" + padded(c, 2) + ".png"; })},
      {"nine folders in a row", NINE, "index of folders",
       grid(NINE, [](int, int c) { return "camera " + padded(c + 1, 1) + "/frame_000123.png"; })},
      {"frames and views in the names", FIVE, "index",
       both(grid(FIVE, [=](int r, int c) { return "Painter_pr_00001_" + padded(index(r, c), 2) + ".png"; }),
            grid(FIVE, [=](int r, int c) { return "Painter_pr_00002_" + padded(index(r, c), 2) + ".png"; }))},
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
      {"a row", ROW, "index", grid(ROW, [](int, int c) { return "view" + padded(c, 1) + ".png"; })},
      {"a folder for each camera", FIVE, "index of folders",
       grid(FIVE, [=](int r, int c) { return "cam_" + padded(index(r, c), 2) + "/image_000.JPG"; }), 5.0},
      {"cameras in two digits", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return "cam_" + padded(r, 1) + padded(c, 1) + "/img.png"; })},
      {"cameras named by row and column", FIVE, "grid of folders",
       grid(FIVE, [](int r, int c) { return "cam_" + padded(r, 2) + "_" + padded(c, 2) + "/0001.png"; })},
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

/// The views of the scene as a plenoptic camera has them: pixel after pixel.
cv::Mat lenslets(const Scene& scene)
{
  const cv::Size size = scene(0, 0).size();
  cv::Mat image(size.height * SIDE, size.width * SIDE, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      image.at<cv::Vec3b>(y, x) = scene(y % SIDE, x % SIDE).at<cv::Vec3b>(y / SIDE, x / SIDE);
    }
  }
  return image;
}

/// Lenslets whose rims are dark, as behind a real lens; most of all those of the corners.
cv::Mat darkRimmedLenslets(const Scene& scene)
{
  cv::Mat image = lenslets(scene);
  constexpr double middle = 0.5 * (SIDE - 1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const double radius = std::hypot(x % SIDE - middle, y % SIDE - middle) / middle;
      image.at<cv::Vec3b>(y, x) *= radius > 1.2 ? 0.05 : radius > 0.9 ? 0.6 : 1.0;
    }
  }
  return image;
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
  for (const auto& some : {namedByRowAndColumn(), namedByIndex(), namedByPosition(), pairs(), singleImages()})
  {
    animals.insert(animals.end(), some.begin(), some.end());
  }
  return animals;
}

/// The view that stands so many steps from the reference.
const View* viewAt(const LightField& light_field, double x, double y)
{
  for (const View& view : light_field.views)
  {
    if (std::hypot(view.steps.x - x, view.steps.y - y) < 0.01)
    {
      return &view;
    }
  }
  return nullptr;
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

TEST(FormatZoo, TakesTheFrameThatIsAskedFor)
{
  const TemporaryFolder folder;
  for (int frame = 0; frame < 3; ++frame)
  {
    for (int camera = 0; camera < 2; ++camera)
    {
      write(folder, "cam_0" + std::to_string(camera) + "/image_" + padded(frame + 10, 3) + ".png",
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

TEST(FormatZoo, TakesMiddleburysCalibration)
{
  const TemporaryFolder folder;
  for (const Animal& animal : pairs())
  {
    if (animal.name == "Middlebury")
    {
      animal.write(folder, RenderedScene::view);
    }
  }
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.place_claim, PlaceClaim::Stated);
  ASSERT_TRUE(dataset.light_field.calibration);
  const Calibration& calibration = *dataset.light_field.calibration;
  EXPECT_DOUBLE_EQ(calibration.focal_length_px, 100.0);
  EXPECT_DOUBLE_EQ(calibration.baseline_m, 0.2);
  EXPECT_DOUBLE_EQ(calibration.disparity_offset_px, 2.5);
  EXPECT_EQ(calibration.principal_point_px, cv::Point2d(41.0, 31.5));
  ASSERT_TRUE(dataset.disparity_range);
  EXPECT_EQ(dataset.disparity_range->max, 12.0F);
}

TEST(FormatZoo, TakesTheCalibrationOfBlendersNames)
{
  const TemporaryFolder folder;
  namedByPosition()[1].write(folder, RenderedScene::view);
  const Dataset dataset = readDataset(folder.path());
  ASSERT_TRUE(dataset.light_field.calibration);
  EXPECT_NEAR(dataset.light_field.calibration->focal_length_px, 80.0 * 30.0 / 36.0, 1e-9);
  EXPECT_NEAR(dataset.light_field.calibration->baseline_m, 0.03075, 1e-9);
  EXPECT_EQ(dataset.light_field.calibration->disparity_offset_px, 0.0);
}

TEST(FormatZoo, TakesTheGridThatIsGiven)
{
  const TemporaryFolder folder;
  grid({4, 3}, [](int r, int c) { return "v" + padded(r * 4 + c, 2) + ".png"; })(folder, RenderedScene::view);
  DatasetOptions options;
  options.grid = cv::Size(4, 3);
  EXPECT_EQ(readDataset(folder.path(), options).light_field.reference().grid, (GridPosition{1, 1}));
  options.grid = cv::Size(3, 3);
  EXPECT_NE(testing::messageOf<InputError>([&] { readDataset(folder.path(), options); }).find("--grid"),
            std::string::npos);
}

TEST(FormatZoo, LeavesOutTheDarkCornersOfLenslets)
{
  const TemporaryFolder folder;
  write(folder, "flower_eslf.png", darkRimmedLenslets(RenderedScene::view));
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.format, "lenslets");
  EXPECT_EQ(dataset.views_found, 21U);
  EXPECT_EQ(viewAt(dataset.light_field, 2, 2), nullptr);
  const View* const view = viewAt(dataset.light_field, 1, -1);
  ASSERT_TRUE(view != nullptr);
  EXPECT_EQ(cv::norm(view->image, RenderedScene::view(1, 3), cv::NORM_INF), 0.0);
}

TEST(FormatZoo, AGreyReferenceMakesAllViewsGrey)
{
  const TemporaryFolder folder;
  write(folder, "left.png", cv::Mat(20, 24, CV_8UC1, 100.0));
  write(folder, "right.png", cv::Mat(20, 24, CV_8UC3, cv::Scalar::all(100.0)));
  const Dataset dataset = readDataset(folder.path());
  for (const View& view : dataset.light_field.views)
  {
    EXPECT_EQ(view.image.type(), CV_8UC1);
    EXPECT_EQ(cv::mean(view.image)[0], 100.0);
  }
  EXPECT_EQ(dataset.notes.size(), 1U);
}

TEST(FormatZoo, TakesKittisCalibration)
{
  const TemporaryFolder folder;
  for (const char* const camera : {"image_0", "image_1"})
  {
    write(folder, camera + std::string("/000000.png"), cv::Mat(20, 24, CV_8UC1, 100.0));
  }
  folder.write("calib.txt", "P0: 700 0 11 0 0 700 9 0 0 0 1 0\nP1: 700 0 11 -378 0 700 9 0 0 0 1 0\n");
  const Dataset dataset = readDataset(folder.path());
  ASSERT_TRUE(dataset.light_field.calibration);
  EXPECT_DOUBLE_EQ(dataset.light_field.calibration->focal_length_px, 700.0);
  EXPECT_DOUBLE_EQ(dataset.light_field.calibration->baseline_m, 0.54);
  EXPECT_EQ(dataset.light_field.calibration->principal_point_px, cv::Point2d(11.0, 9.0));
}

TEST(FormatZoo, SaysWhatToDoWithFilesThatAreNoImages)
{
  for (const auto& [file, word] :
       {std::make_pair("buddha.h5", "HDF5"), std::make_pair("IMG_0001.LFP", "plenoptic"),
        std::make_pair("LF.mat", "MATLAB"), std::make_pair("scene.mp4", "video")})
  {
    const TemporaryFolder folder;
    folder.write(file, "content");
    const std::string message = testing::messageOf<InputError>([&] { readDataset(folder.path()); });
    EXPECT_NE(message.find(file), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(FormatZoo, ListsWhatWasTried)
{
  const TemporaryFolder folder;
  write(folder, "holiday.png", cv::Mat(40, 40, CV_8UC1, 7.0));
  write(folder, "dog.png", cv::Mat(40, 40, CV_8UC1, 7.0));
  const std::string message = testing::messageOf<InputError>([&] { readDataset(folder.path()); });
  for (const char* const part : {"dog.png", "HCI", "Middlebury", "no name has a number", "light_field.yaml"})
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(FormatZoo, RefusesPipesLoopsAndEmptyLists)
{
  const TemporaryFolder folder;
  grid(PAIR, [](int, int c) { return "00_0" + std::to_string(c) + ".png"; })(folder, RenderedScene::view);
  const auto complaint = [&] { return testing::messageOf<InputError>([&] { readDataset(folder.path()); }); };
  folder.write("light_field.yaml", "views: []\n");
  EXPECT_NE(complaint().find("views"), std::string::npos);
  folder.write("light_field.yaml",
               "pattern: '" + std::string(300, 'x') + "{row}_{column}.png'\ngrid: {rows: 1, columns: 2}\n");
  EXPECT_NE(complaint().find("is there"), std::string::npos);
  std::filesystem::remove(folder / "light_field.yaml");
  std::filesystem::create_symlink("light_field.yaml", folder / "light_field.yaml");
  EXPECT_NE(complaint().find("light_field.yaml"), std::string::npos);
  std::filesystem::remove(folder / "light_field.yaml");
  ASSERT_EQ(std::system(("mkfifo '" + (folder / "light_field.yaml").string() + "'").c_str()), 0);
  EXPECT_NE(complaint().find("regular file"), std::string::npos);
  folder.write("b/light_field.yaml",
               "views: [{row: 0, column: 0, file: zero.png}, {row: 0, column: 1, file: zero.png}]\n");
  std::filesystem::create_symlink("/dev/zero", folder / "b/zero.png");
  EXPECT_NE(testing::messageOf<InputError>([&] { readDataset(folder / "b"); }).find("zero.png"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
