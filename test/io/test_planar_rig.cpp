// Light fields that are described by the poses of their cameras.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "dataset_files.h"
#include "light_field_depth/io/dataset.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::readingError;
using testing::says;
using testing::TemporaryFolder;

constexpr int SIDE = 3;
constexpr double STEP_M = 0.1;
constexpr double FOCAL_LENGTH_PX = 100.0;
constexpr double TURN_RAD = 0.4;  ///< of the whole rig in the world, around its vertical axis
const cv::Size SIZE(80, 64);

cv::Mat viewImage(int row, int column)
{
  cv::Mat image(SIZE, CV_8UC3, cv::Scalar::all(20.0 * row + 5.0 * column));
  cv::circle(image, {30 + 3 * column, 20 + 5 * row}, 6, cv::Scalar(40, 90, 220), -1);
  return image;
}

void writeImages(const TemporaryFolder& folder, const std::string& prefix)
{
  std::filesystem::create_directories((folder / (prefix + "x")).parent_path());
  for (int row = 0; row < SIDE; ++row)
  {
    for (int column = 0; column < SIDE; ++column)
    {
      const std::string name = prefix + "frame" + std::to_string(row * SIDE + column) + ".png";
      ASSERT_TRUE(cv::imwrite((folder / name).string(), viewImage(row, column)));
    }
  }
}

cv::Matx33d rigRotation(double angle_rad)
{
  return {std::cos(angle_rad), 0, std::sin(angle_rad), 0, 1, 0, -std::sin(angle_rad), 0, std::cos(angle_rad)};
}

/// Where a camera stands in the world; `off_m` in front of the plane.
cv::Vec3d centreOf(int row, int column, double off_m = 0.0)
{
  return rigRotation(TURN_RAD) * cv::Vec3d(STEP_M * column + 7.0, STEP_M * row - 3.0, off_m + 2.0);
}

/// A model of COLMAP. @param tilt_rad of the cameras against the normal of their plane
void writeColmap(const TemporaryFolder& folder, double tilt_rad, double off_m)
{
  folder.write("sparse/0/cameras.txt", "# comment\n1 PINHOLE 80 64 100 100 40 32\n");
  std::ostringstream images;
  images.precision(12);
  const double angle = TURN_RAD + tilt_rad;
  const cv::Matx33d to_camera = rigRotation(angle).t();
  for (int i = 0; i < SIDE * SIDE; ++i)
  {
    const cv::Vec3d t = -(to_camera * centreOf(i / SIDE, i % SIDE, i == 4 ? off_m : 0.0));
    images << i + 1 << " " << std::cos(angle / 2) << " 0 " << -std::sin(angle / 2) << " 0 " << t[0] << " "
           << t[1] << " " << t[2] << " 1 frame" << i << ".png\n\n";
  }
  folder.write("sparse/0/images.txt", images.str());
}

/// Rows of a matrix from the camera to the world, with the axes of OpenGL.
std::string poseText(int row, int column)
{
  const cv::Matx33d rotation = rigRotation(TURN_RAD) * cv::Matx33d(1, 0, 0, 0, -1, 0, 0, 0, -1);
  const cv::Vec3d centre = centreOf(row, column);
  std::ostringstream text;
  text.precision(12);
  for (int i = 0; i < 3; ++i)
  {
    text << (i == 0 ? "[[" : ", [") << rotation(i, 0) << ", " << rotation(i, 1) << ", " << rotation(i, 2)
         << ", " << centre[i] << "]";
  }
  text << ", [0, 0, 0, 1]]";
  return text.str();
}

std::string framesText(const std::string& name_field, const std::string& matrix_field,
                       const std::string& prefix)
{
  std::string text = "\"frames\": [";
  for (int i = 0; i < SIDE * SIDE; ++i)
  {
    text += std::string(i > 0 ? ", " : "") + "{\"" + name_field + "\": \"" + prefix + "frame" +
            std::to_string(i) + "\", \"" + matrix_field + "\": " + poseText(i / SIDE, i % SIDE) + "}";
  }
  return text + "]";
}

void expectGrid(const Dataset& dataset, const std::string& format)
{
  EXPECT_EQ(dataset.format, format);
  EXPECT_EQ(dataset.place_claim, PlaceClaim::Stated);
  ASSERT_EQ(dataset.light_field.views.size(), 9U);
  ASSERT_TRUE(dataset.light_field.calibration);
  EXPECT_NEAR(dataset.light_field.calibration->baseline_m, STEP_M, 1e-9);
  EXPECT_NEAR(dataset.light_field.calibration->focal_length_px, FOCAL_LENGTH_PX, 1e-6);
  for (const View& view : dataset.light_field.views)
  {
    const int row = static_cast<int>(std::lround(view.steps.y)) + 1;
    const int column = static_cast<int>(std::lround(view.steps.x)) + 1;
    EXPECT_NEAR(view.steps.x, column - 1, 1e-6);
    EXPECT_NEAR(view.steps.y, row - 1, 1e-6);
    EXPECT_EQ(view.grid, (GridPosition{row, column}));
    EXPECT_EQ(cv::norm(view.image, viewImage(row, column), cv::NORM_INF), 0.0) << row << " " << column;
  }
}

TEST(PlanarRig, ColmapsModelGivesPlacesAndCalibration)
{
  const TemporaryFolder folder;
  writeImages(folder, "images/");
  writeColmap(folder, 0.0, 0.0);
  expectGrid(readDataset(folder.path()), "colmap");
}

TEST(PlanarRig, TransformsGivePlacesAndCalibration)
{
  const TemporaryFolder folder;
  writeImages(folder, "train/");
  folder.write("transforms.json", "{\"fl_x\": 100, \"cx\": 40, \"cy\": 32, \"w\": 80, \"h\": 64, " +
                                      framesText("file_path", "transform_matrix", "./train/") + "}");
  expectGrid(readDataset(folder.path()), "transforms");
}

TEST(PlanarRig, TheViewsToTrainWithAreReadWhereThereAreSeveralParts)
{
  const TemporaryFolder folder;
  writeImages(folder, "train/");
  folder.write("transforms_test.json", "{}");
  folder.write("transforms_train.json", "{\"fl_x\": 100, \"cx\": 40, \"cy\": 32, \"w\": 80, \"h\": 64, " +
                                            framesText("file_path", "transform_matrix", "./train/") + "}");
  expectGrid(readDataset(folder.path()), "transforms");
}

TEST(PlanarRig, TheAddOnOfIdLabGivesPlacesAndCalibration)
{
  const TemporaryFolder folder;
  writeImages(folder, "png/");
  folder.write("lightfield.json",
               "{\"camera\": {\"type\": \"PERSP\", \"lens_unit\": \"MILLIMETERS\", \"focal_length\": 45.0}, "
               "\"lf_type\": \"PLANE\", \"resolution\": [80, 64], \"sensor_size\": [36.0, 28.8], " +
                   framesText("name", "world_matrix", "") + "}");
  expectGrid(readDataset(folder.path()), "idlab");
}

/// Cameras that look aside see the middle of their images along the normal after the warp.
TEST(PlanarRig, CamerasThatLookAsideAreRectified)
{
  const TemporaryFolder folder;
  writeImages(folder, "");
  writeColmap(folder, 0.1, 0.0);
  const Dataset dataset = readDataset(folder.path());
  ASSERT_FALSE(dataset.notes.empty());
  EXPECT_TRUE(says(dataset.notes.front(), {"9 of 9", "rectified"}));
  EXPECT_NEAR(dataset.light_field.views.back().steps.x, 1.0, 1e-6);
  // The axis of the cameras, 0.1 rad aside, is still in the middle of the image.
  const Calibration& calibration = *dataset.light_field.calibration;
  EXPECT_NEAR(calibration.principal_point_px.x, 39.5 - FOCAL_LENGTH_PX * std::tan(0.1), 1e-6);
}

TEST(PlanarRig, SaysHowFarFromAPlaneTheCamerasStand)
{
  const TemporaryFolder folder;
  writeImages(folder, "");
  writeColmap(folder, 0.0, 0.05);
  EXPECT_TRUE(says(readingError(folder.path()), {"common plane", "% of the rig's width"}));
  writeColmap(folder, 1.0, 0.0);
  EXPECT_TRUE(says(readingError(folder.path()), {"57 degrees", "frame0.png"}));
}

TEST(PlanarRig, NamesWhatIsWrongInItsFiles)
{
  const TemporaryFolder folder;
  writeImages(folder, "");
  for (const char* const content : {"{", "{\"frames\": 3}", "{\"frames\": [{\"file_path\": \"frame0\"}]}",
                                    "{\"w\": 80, \"h\": 64, \"frames\": []}"})
  {
    folder.write("transforms.json", content);
    EXPECT_TRUE(says(readingError(folder.path()), {folder.path().c_str()})) << content;
  }
  std::filesystem::remove(folder / "transforms.json");
  for (const char* const content :
       {"1 FISHEYE 80 64 100 40 32\n", "1 PINHOLE 80 64 -1 1 1 1\n", "nonsense\n"})
  {
    folder.write("cameras.txt", content);
    folder.write("images.txt", "1 1 0 0 0 0 0 0 1 frame0.png\n\n");
    EXPECT_TRUE(says(readingError(folder.path()), {"cameras.txt"})) << content;
  }
  folder.write("cameras.txt", "1 PINHOLE 80 64 100 100 40 32\n");
  folder.write("images.txt", "1 1 0 0 0 0 0 0 2 frame0.png\n\n");
  EXPECT_TRUE(says(readingError(folder.path()), {"images.txt", "known camera"}));
}

}  // namespace
}  // namespace light_field_depth
