#include <cstdint>
#include <string>
#include <vector>

#include <ros/ros.h>

#include "tools/dataset_input.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
constexpr std::uint32_t QUEUE_SIZE = 2;  // the next set while one is being sent

struct ViewPublishers
{
  ros::Publisher image;
  ros::Publisher camera_info;
};

std::vector<ViewPublishers> advertise(const std::vector<ViewMessages>& views)
{
  ros::NodeHandle node_handle;
  std::vector<ViewPublishers> publishers;
  publishers.reserve(views.size());
  for (const ViewMessages& view : views)
  {
    publishers.push_back(
        {node_handle.advertise<sensor_msgs::Image>(view.image_topic, QUEUE_SIZE),
         node_handle.advertise<sensor_msgs::CameraInfo>(view.camera_info_topic, QUEUE_SIZE)});
  }
  return publishers;
}

void publish(const std::vector<ViewMessages>& views, const std::vector<ViewPublishers>& publishers)
{
  const ros::Time stamp = ros::Time::now();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    // No other thread of this process reads them: subscribers get a serialised copy.
    views[i].camera_info->header.stamp = stamp;
    views[i].image->header.stamp = stamp;
    publishers[i].camera_info.publish(*views[i].camera_info);
    publishers[i].image.publish(*views[i].image);
  }
}

void play(const DatasetInputOptions& options, bool loop)
{
  const CalibratedDataset dataset = readCalibratedDataset(options);
  if (!dataset.warning.empty())
  {
    ROS_WARN_STREAM(dataset.warning);
  }
  std_msgs::Header header;
  header.frame_id = options.frame_id;
  const std::vector<ViewMessages> views =
      viewMessages(dataset.light_field, *dataset.light_field.calibration, header, options.topics);
  const std::vector<ViewPublishers> publishers = advertise(views);
  ROS_INFO_STREAM("Playing " << views.size() << " views of " << options.folder << ", "
                             << views.front().image_topic << " to " << views.back().image_topic << ".");
  ros::WallRate rate(options.rate_hz);
  do
  {
    rate.sleep();
    publish(views, publishers);
    ros::spinOnce();
  } while (loop && ros::ok());
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "light_field_player");
  CLI::App app("Publishes a light field from a folder as a camera array would.", "light_field_player");
  DatasetInputOptions options;
  bool loop = false;
  addDatasetInputOptions(app, options);
  app.add_option("--loop", loop, "true: go on until stopped")->capture_default_str();
  return runTool(app, argc, argv, [&] { play(options, loop); });
}
