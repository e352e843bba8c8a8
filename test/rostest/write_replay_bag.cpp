#include <cstdlib>

#include <ros/time.h>
#include <rosbag/bag.h>

#include "light_field_depth/ros/view_messages.h"
#include "support/synthetic_scene.h"

namespace
{
constexpr int FRAMES = 3;
constexpr double FRAME_PERIOD_S = 0.2;
}  // namespace

/// write_replay_bag FILE: a bag of three frames of a synthetic 3 x 3 array.
int main(int argc, char** argv)
{
  using namespace light_field_depth;
  if (argc != 2)
  {
    return EXIT_FAILURE;
  }
  testing::SceneSettings settings;
  settings.size = {64, 48};
  settings.positions = testing::gridPositions(3, 3);
  settings.calibration = Calibration{80.0, {31.5, 23.5}, 0.1, 5.0};
  const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
  std_msgs::Header header;
  header.frame_id = "light_field_optical_frame";
  rosbag::Bag bag(argv[1], rosbag::bagmode::Write);
  for (int frame = 0; frame < FRAMES; ++frame)
  {
    header.stamp = ros::Time(1000.0 + frame * FRAME_PERIOD_S);
    for (const ViewMessages& view : viewMessages(scene.light_field, *settings.calibration, header))
    {
      bag.write(view.camera_info_topic, header.stamp, *view.camera_info);
      bag.write(view.image_topic, header.stamp, *view.image);
    }
  }
  return EXIT_SUCCESS;
}
