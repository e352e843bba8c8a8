#include "array_fixture.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "light_field_depth/ros/view_array.h"
#include "support/sanitizers.h"

namespace light_field_depth::testing
{
namespace
{
constexpr std::chrono::milliseconds POLL_PERIOD(2);
constexpr std::chrono::milliseconds FRAME_PERIOD(50);
constexpr int SPINNER_THREADS = 2;

const Calibration& arrayCalibration()
{
  static const Calibration calibration = []
  {
    Calibration values;
    values.focal_length_px = 100.0;
    values.principal_point_px = {47.5, 35.5};
    values.baseline_m = 0.1;
    values.disparity_offset_px = 5.0;
    return values;
  }();
  return calibration;
}

}  // namespace

bool waitFor(const std::function<bool()>& condition, std::chrono::milliseconds deadline)
{
  const auto end = std::chrono::steady_clock::now() + SLOWNESS * deadline;
  while (!condition())
  {
    if (std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    std::this_thread::sleep_for(POLL_PERIOD);
  }
  return true;
}

SyntheticLightField syntheticArray(std::vector<GridPosition> positions, const cv::Size& size)
{
  SceneSettings settings;
  settings.positions = std::move(positions);
  settings.size = size;
  settings.calibration = arrayCalibration();
  return renderScene(standardScene(size), settings);
}

ArrayPublisher::ArrayPublisher(ros::NodeHandle node_handle, const LightField& light_field, bool latch_infos,
                               const TopicPatterns& patterns)
{
  std_msgs::Header header;
  header.frame_id = "array_optical_frame";
  messages_ = viewMessages(light_field, *light_field.calibration, header, patterns);
  for (const ViewMessages& view : messages_)
  {
    image_publishers_.push_back(node_handle.advertise<sensor_msgs::Image>(view.image_topic, 20));
    info_publishers_.push_back(
        node_handle.advertise<sensor_msgs::CameraInfo>(view.camera_info_topic, 20, latch_infos));
  }
}

void ArrayPublisher::publish(const ros::Time& stamp)
{
  const auto all = [](std::size_t) { return true; };
  publishInfos(stamp, all);
  publishImages(stamp, all);
}

void ArrayPublisher::publishImages(const ros::Time& stamp, const std::function<bool(std::size_t)>& wanted)
{
  for (std::size_t view = 0; view < messages_.size(); ++view)
  {
    if (wanted(view))
    {
      const auto image = boost::make_shared<sensor_msgs::Image>(*messages_[view].image);
      image->header.stamp = stamp;
      image_publishers_[view].publish(image);
    }
  }
}

void ArrayPublisher::publishInfos(const ros::Time& stamp, const std::function<bool(std::size_t)>& wanted)
{
  for (std::size_t view = 0; view < messages_.size(); ++view)
  {
    if (wanted(view))
    {
      const auto info = boost::make_shared<sensor_msgs::CameraInfo>(*messages_[view].camera_info);
      info->header.stamp = stamp;
      info_publishers_[view].publish(info);
    }
  }
}

std::size_t ArrayPublisher::topicsHeard() const
{
  std::size_t heard = 0;
  for (const ros::Publisher& publisher : image_publishers_)
  {
    heard += publisher.getNumSubscribers() > 0 ? 1 : 0;
  }
  for (const ros::Publisher& publisher : info_publishers_)
  {
    heard += publisher.getNumSubscribers() > 0 ? 1 : 0;
  }
  return heard;
}

bool diagnosed(const Listener<diagnostic_msgs::DiagnosticArray>& listener,
               const std::vector<std::string>& words)
{
  for (const auto& array : listener.all())
  {
    for (const auto& status : array->status)
    {
      if (std::all_of(words.begin(), words.end(),
                      [&](const std::string& word)
                      { return status.message.find(word) != std::string::npos; }))
      {
        return true;
      }
    }
  }
  return false;
}

void ArrayFixture::SetUp()
{
  const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string space;
  for (const char letter : name)
  {
    space += letter == '/' ? '_' : letter;
  }
  array_space_ = std::make_unique<ros::NodeHandle>("/" + space);
  node_space_ = std::make_unique<ros::NodeHandle>("/" + space + "/depth");
  spinner_ = std::make_unique<ros::AsyncSpinner>(SPINNER_THREADS);
  spinner_->start();
}

void ArrayFixture::TearDown()
{
  node_.reset();
  spinner_->stop();
}

void ArrayFixture::startNode(const LightField& light_field, const TopicPatterns& patterns, ResultSaver saver,
                             const std::map<std::string, std::string>& fields)
{
  XmlRpc::XmlRpcValue array;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const GridPosition& grid = light_field.views[i].grid;
    XmlRpc::XmlRpcValue& view = array["views"][static_cast<int>(i)];
    view["row"] = grid.row;
    view["column"] = grid.column;
    view["image"] = topicFromPattern(patterns.image, grid);
    view["camera_info"] = topicFromPattern(patterns.camera_info, grid);
    for (const auto& [name, pattern] : fields)
    {
      view[name] = topicFromPattern(pattern, grid);
    }
  }
  node_space_->setParam("array", array);
  node_ = std::make_unique<DepthNode>(*array_space_, *node_space_, std::move(saver));
}

ros::Time ArrayFixture::nextStamp()
{
  stamp_ += ros::Duration(0.1);
  return stamp_;
}

bool ArrayFixture::publishUntil(ArrayPublisher& array, const std::function<bool()>& condition)
{
  const auto end = std::chrono::steady_clock::now() + SLOWNESS * std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end)
  {
    array.publish(nextStamp());
    if (waitFor(condition, FRAME_PERIOD))
    {
      return true;
    }
  }
  return false;
}

}  // namespace light_field_depth::testing
