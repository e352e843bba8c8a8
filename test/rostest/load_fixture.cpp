#include "load_fixture.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <utility>

#include <topic_tools/shape_shifter.h>

#include "light_field_depth/ros/view_messages.h"

namespace light_field_depth::testing
{
namespace
{
constexpr std::uint32_t QUEUE_SIZE = 2;
constexpr std::uint32_t STATS_QUEUE_SIZE = 1000;
constexpr double BYTES_PER_MB = 1e6;

}  // namespace

double soakSeconds()
{
  const char* const seconds = std::getenv("LIGHT_FIELD_DEPTH_SOAK_SECONDS");
  return seconds == nullptr ? 0.0 : std::atof(seconds);
}

void report(const std::string& line)
{
  std::cout << line << std::endl;
  if (const char* const page = std::getenv("LIGHT_FIELD_DEPTH_SOAK_PAGE"))
  {
    std::ofstream(page, std::ios::app) << line << '\n';
  }
}

double residentMb()
{
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;  // the second number counts what is resident
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / BYTES_PER_MB;
}

int threadCount()
{
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return static_cast<int>(std::distance(begin(threads), end(threads)));
}

DriverArray::DriverArray(ros::NodeHandle space, const LightField& light_field)
{
  std_msgs::Header header;
  header.frame_id = "array_optical_frame";
  for (ViewMessages& view : viewMessages(light_field, *light_field.calibration, header))
  {
    drivers_.push_back({space.advertise<sensor_msgs::Image>(view.image_topic, QUEUE_SIZE),
                        space.advertise<sensor_msgs::CameraInfo>(view.camera_info_topic, QUEUE_SIZE, true),
                        view.camera_info,
                        {view.image}});
    drivers_.back().info_publisher.publish(view.camera_info);
  }
}

sensor_msgs::ImagePtr DriverArray::freeImage(Driver& driver)
{
  const auto unused = std::find_if(driver.images.begin(), driver.images.end(),
                                   [](const sensor_msgs::ImagePtr& image) { return image.use_count() == 1; });
  if (unused != driver.images.end())
  {
    return *unused;
  }
  driver.images.push_back(boost::make_shared<sensor_msgs::Image>(*driver.images.front()));
  return driver.images.back();
}

void DriverArray::publish(const ros::Time& stamp)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Driver& driver : drivers_)
  {
    const sensor_msgs::ImagePtr image = freeImage(driver);
    image->header.stamp = stamp;
    driver.image_publisher.publish(image);
  }
}

bool DriverArray::isHeard() const
{
  return std::all_of(drivers_.begin(), drivers_.end(),
                     [](const Driver& driver) {
                       return driver.image_publisher.getNumSubscribers() > 0 &&
                              driver.info_publisher.getNumSubscribers() > 0;
                     });
}

double DriverArray::imagesMb() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  double bytes = 0.0;
  for (const Driver& driver : drivers_)
  {
    bytes += static_cast<double>(driver.images.size() * driver.images.front()->data.size());
  }
  return bytes / BYTES_PER_MB;
}

std::size_t DriverArray::imagesHeld() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t held = 0;
  for (const Driver& driver : drivers_)
  {
    held += static_cast<std::size_t>(std::count_if(driver.images.begin(), driver.images.end(),
                                                   [](const sensor_msgs::ImagePtr& image)
                                                   { return image.use_count() > 1; }));
  }
  return held;
}

StatsReader::StatsReader(ros::NodeHandle node_space)
{
  node_space.setCallbackQueue(&queue_);
  const boost::function<void(const LightFieldDepthStatsConstPtr&)> callback =
      [this](const LightFieldDepthStatsConstPtr& stats) { add(stats); };
  subscriber_ = node_space.subscribe<LightFieldDepthStats>("stats", STATS_QUEUE_SIZE, callback);
  spinner_.start();
}

StatsReader::~StatsReader()
{
  subscriber_.shutdown();
  spinner_.stop();
}

void StatsReader::add(const LightFieldDepthStatsConstPtr& stats)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = *stats;
  times_.latency_ms.push_back(stats->latency_ms);
  times_.longest_computing_ms = std::max(times_.longest_computing_ms, stats->latency_ms - stats->waiting_ms);
  times_.all_views = times_.all_views && std::all_of(stats->used_by_view.begin(), stats->used_by_view.end(),
                                                     [](std::uint8_t used) { return used != 0; });
  ++count_;
}

LightFieldDepthStats StatsReader::newest() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

StatsReader::Times StatsReader::takeTimes()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(times_, Times());
}

ros::Subscriber listenTo(ros::NodeHandle node_space, const std::string& result)
{
  const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> nothing =
      [](const topic_tools::ShapeShifter::ConstPtr&) {};
  return node_space.subscribe<topic_tools::ShapeShifter>(result, 1, nothing);
}

bool LoadFixture::load(const std::string& name, int rows, int columns)
{
  const ros::NodeHandle node_space(name + "/depth");
  node_space.setParam("array/rows", rows);
  node_space.setParam("array/columns", columns);
  node_space.setParam("array/layout", "all");
  node_space.setParam("queue_size", 50);  // on a busy machine ROS loses what does not fit in there
  return loader_.load(name + "/depth", "light_field_depth/DepthNodelet", {}, {});
}

Flood::Flood(DriverArray& array, double rate_hz)
    : array_(array), stamp_(ros::Time::now()), thread_(
                                                   [this, rate_hz]
                                                   {
                                                     ros::WallRate rate(rate_hz);
                                                     while (!stopped_)
                                                     {
                                                       stamp_ = ros::Time::now();
                                                       array_.publish(stamp_);
                                                       ++sets_;
                                                       rate.sleep();
                                                     }
                                                   })
{
}

Flood::~Flood()
{
  stop();
}

ros::Time Flood::stop()
{
  stopped_ = true;
  if (thread_.joinable())
  {
    thread_.join();
  }
  return stamp_;
}

}  // namespace light_field_depth::testing
