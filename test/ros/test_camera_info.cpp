#include "ros/camera_info.h"

#include <gtest/gtest.h>
#include <image_geometry/pinhole_camera_model.h>

namespace light_field_depth
{
namespace
{
sensor_msgs::CameraInfo fullCamera()
{
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K = {500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {490.0, 0.0, 318.0, -49.0, 0.0, 495.0, 236.0, 24.75, 0.0, 0.0, 1.0, 0.0};
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  return info;
}

TEST(CameraInfo, ReadsBinningAndRegionAsImageGeometryDoes)
{
  sensor_msgs::CameraInfo info = fullCamera();
  info.binning_x = 2;
  info.binning_y = 4;
  info.roi.x_offset = 40;
  info.roi.y_offset = 80;
  info.roi.width = 200;
  info.roi.height = 160;
  image_geometry::PinholeCameraModel model;
  ASSERT_TRUE(model.fromCameraInfo(info));
  const sensor_msgs::CameraInfo delivered = ofDeliveredImage(info);
  EXPECT_EQ(delivered.width, 100U);
  EXPECT_EQ(delivered.height, 40U);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      EXPECT_DOUBLE_EQ(delivered.P[static_cast<std::size_t>(4 * row + column)],
                       model.projectionMatrix()(row, column));
    }
    for (int column = 0; column < 3; ++column)
    {
      EXPECT_DOUBLE_EQ(delivered.K[static_cast<std::size_t>(3 * row + column)],
                       model.intrinsicMatrix()(row, column));
    }
  }
  EXPECT_FALSE(sameCamera(info, delivered));
  EXPECT_TRUE(sameCamera(delivered, ofDeliveredImage(delivered))) << "applied once";
}

TEST(CameraInfo, LeavesAFullImageAsItIs)
{
  EXPECT_TRUE(sameCamera(fullCamera(), ofDeliveredImage(fullCamera())));
}

TEST(CameraInfo, TellsWhatARawImageNeeds)
{
  sensor_msgs::CameraInfo info = fullCamera();
  EXPECT_FALSE(isDistortedOrTurned(info));
  info.R.fill(0.0);
  EXPECT_FALSE(isDistortedOrTurned(info)) << "not set";
  info.R = {0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0};
  EXPECT_TRUE(isDistortedOrTurned(info));
  info = fullCamera();
  info.D[1] = 0.01;
  EXPECT_TRUE(isDistortedOrTurned(info));
}

}  // namespace
}  // namespace light_field_depth
