// What the cameras' CameraInfo may say.

#include <string>

#include <camera_calibration_parsers/parse.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Empty.h>
#include <stereo_msgs/DisparityImage.h>

#include "array_fixture.h"
#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
namespace
{
using CamerasTest = ArrayFixture;
using DisparityListener = Listener<stereo_msgs::DisparityImage>;
using ImageListener = Listener<sensor_msgs::Image>;
using InfoListener = Listener<sensor_msgs::CameraInfo>;

const cv::Size SMALL(64, 48);
const auto EVERY_VIEW = [](std::size_t) { return true; };

TEST_F(CamerasTest, GoOnAfterAResetThoughTheirInfosAreLatched)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field, true);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  array.publishInfos(nextStamp(), EVERY_VIEW);
  const auto images_until = [&](std::size_t count)
  {
    return waitFor(
        [&]
        {
          array.publishImages(nextStamp(), EVERY_VIEW);
          return waitFor([&] { return disparity.count() > count; }, std::chrono::milliseconds(50));
        });
  };
  ASSERT_TRUE(images_until(0));
  std_srvs::Empty call;
  ASSERT_TRUE(ros::service::call(node_space_->resolveName("reset"), call));
  EXPECT_TRUE(images_until(disparity.count()));
}

TEST_F(CamerasTest, MayBinAndCropTheirImages)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    sensor_msgs::CameraInfo& info = array.info(view);
    info.width = 640;
    info.height = 480;
    info.binning_x = info.binning_y = 2;
    info.roi.x_offset = 100;
    info.roi.y_offset = 60;
    info.roi.width = 2 * 64;
    info.roi.height = 2 * 48;
    for (std::size_t i = 0; i < 8; ++i)
    {
      info.P[i] *= 2.0;
    }
    info.P[2] += 100;
    info.P[6] += 60;
  }
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const InfoListener info(*node_space_, "camera_info");
  ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0 && info.count() > 0; }));
  const Calibration& calibration = *scene.light_field.calibration;
  EXPECT_FLOAT_EQ(disparity.newest()->f, static_cast<float>(calibration.focal_length_px));
  EXPECT_FLOAT_EQ(disparity.newest()->T, static_cast<float>(calibration.baseline_m));
  EXPECT_EQ(info.newest()->width, 64U);
  EXPECT_NEAR(info.newest()->P[2], calibration.principal_point_px.x, 1e-9);
  EXPECT_EQ(info.newest()->binning_x, 0U);
}

TEST_F(CamerasTest, WithoutCalibrationHaveDisparityButNoDepth)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    array.info(view).P.fill(0.0);
  }
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const ImageListener confidence(*node_space_, "confidence");
  const ImageListener color(*node_space_, "disparity_color");
  const ImageListener depth(*node_space_, "depth");
  const Listener<sensor_msgs::PointCloud2> points2(*node_space_, "points2");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(publishUntil(array,
                           [&]
                           {
                             return disparity.count() > 0 && confidence.count() > 0 && color.count() > 0 &&
                                    diagnosed(diagnostics, {"P of zeros", "no depth"});
                           }));
  EXPECT_EQ(disparity.newest()->f, 0.0F);
  EXPECT_EQ(depth.count() + points2.count(), 0U);
}

TEST_F(CamerasTest, AtOnePlaceHaveDisparityButNoDepth)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    array.info(view).P[3] = 0.0;
  }
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(
      publishUntil(array,
                   [&] {
                     return disparity.count() > 0 && diagnosed(diagnostics, {"one point", "baseline_x"});
                   }));
  EXPECT_EQ(disparity.newest()->T, 0.0F);
}

TEST_F(CamerasTest, KnownByParametersAloneHaveACameraInfo)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("use_camera_info", false);
  setParameter("focal_length", 80.0);
  setParameter("baseline_x", 0.2);
  startNode(scene.light_field);
  const InfoListener info(*node_space_, "camera_info");
  ASSERT_TRUE(publishUntil(array, [&] { return info.count() > 0; }));
  EXPECT_EQ(info.newest()->width, 64U);
  EXPECT_DOUBLE_EQ(info.newest()->P[0], 80.0);
  EXPECT_DOUBLE_EQ(info.newest()->P[2], 31.5);
}

TEST_F(CamerasTest, GiveTheParallelPairThatTheDisparityBelongsTo)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  const Calibration& calibration = *scene.light_field.calibration;
  ASSERT_NE(calibration.disparity_offset_px, 0.0) << "views whose principal points differ";
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const InfoListener left(*node_space_, "left/camera_info");
  const InfoListener right(*node_space_, "right/camera_info");
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(
      publishUntil(array, [&] { return left.count() > 0 && right.count() > 0 && disparity.count() > 0; }));
  EXPECT_EQ(left.newest()->header.stamp, disparity.newest()->header.stamp);
  EXPECT_EQ(left.newest()->header.frame_id, disparity.newest()->header.frame_id);
  EXPECT_EQ(left.newest()->P[3], 0.0);
  EXPECT_NEAR(right.newest()->P[3], -calibration.focal_length_px * calibration.baseline_m, 1e-9);
  EXPECT_EQ(left.newest()->P[2], right.newest()->P[2]);
  EXPECT_NEAR(left.newest()->P[2], calibration.principal_point_px.x, 1e-9);
}

TEST_F(CamerasTest, WhoseTopicsDoNotSayRectifiedAreWarnedAbout)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  TopicPatterns raw;
  raw.image = "view_{row}_{column}/image_raw";
  ArrayPublisher array(*array_space_, scene.light_field, false, raw);
  array.info(1).D[0] = -0.2;
  startNode(scene.light_field, raw);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(publishUntil(
      array,
      [&] {
        return disparity.count() > 0 && diagnosed(diagnostics, {"View (0, 1)", "distortion", "rectified"});
      }));
}

TEST_F(CamerasTest, MayHaveTheirCalibrationInFiles)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  const TemporaryFolder folder;
  for (std::size_t view = 0; view < 3; ++view)
  {
    ASSERT_TRUE(camera_calibration_parsers::writeCalibration(
        (folder / ("view_0_" + std::to_string(view) + ".yaml")).string(), "view", array.info(view)));
  }
  startNode(scene.light_field, {}, nullptr,
            {{"camera_info_url", "file://" + folder.path().string() + "/view_{row}_{column}.yaml"}});
  const DisparityListener disparity(*node_space_, "disparity");
  const auto images_until = [&](std::size_t count)
  {
    return waitFor(
        [&]
        {
          array.publishImages(nextStamp(), EVERY_VIEW);
          return waitFor([&] { return disparity.count() > count; }, std::chrono::milliseconds(50));
        });
  };
  ASSERT_TRUE(images_until(0)) << "no CameraInfo is published";
  EXPECT_NEAR(disparity.newest()->T, scene.light_field.calibration->baseline_m, 1e-6);
  std_srvs::Empty call;
  ASSERT_TRUE(ros::service::call(node_space_->resolveName("reset"), call));
  EXPECT_TRUE(images_until(disparity.count())) << "a reset leaves the files";
}

}  // namespace
}  // namespace light_field_depth::testing
