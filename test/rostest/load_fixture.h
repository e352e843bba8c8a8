#ifndef LIGHT_FIELD_DEPTH_TEST_ROSTEST_LOAD_FIXTURE_H
#define LIGHT_FIELD_DEPTH_TEST_ROSTEST_LOAD_FIXTURE_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

namespace light_field_depth::testing
{
/// Seconds that a long run takes, from LIGHT_FIELD_DEPTH_SOAK_SECONDS; 0: a short run, as among the tests.
double soakSeconds();
inline bool isSoak()
{
  return soakSeconds() > 0.0;
}

/// Prints a line, and adds it to the page of results that LIGHT_FIELD_DEPTH_SOAK_PAGE names.
void report(const std::string& line);

/// Memory that this process has in use, in MB, and its threads.
double residentMb();
int threadCount();

/// Cameras in the process of the node, as drivers in its nodelet manager are: their messages reach it without
/// a copy, and are used again when nobody has them any more. One view's messages keep their pixels.
class DriverArray
{
public:
  DriverArray(ros::NodeHandle space, const LightField& light_field);

  /// Publishes all views with one stamp.
  void publish(const ros::Time& stamp);
  bool isHeard() const;  ///< on every topic
  /// Memory of the images that were ever needed at one time, in MB, and how many of them somebody has still.
  double imagesMb() const;
  std::size_t imagesHeld() const;

private:
  struct Driver
  {
    ros::Publisher image_publisher;
    ros::Publisher info_publisher;
    sensor_msgs::CameraInfoPtr info;
    std::vector<sensor_msgs::ImagePtr> images;
  };

  static sensor_msgs::ImagePtr freeImage(Driver& driver);

  mutable std::mutex mutex_;  // of the lists of images
  std::vector<Driver> drivers_;
};

/// The stats of a node, frame by frame, with a queue and a thread of its own, so that none is lost.
class StatsReader
{
public:
  explicit StatsReader(ros::NodeHandle node_space);
  ~StatsReader();
  StatsReader(const StatsReader&) = delete;
  StatsReader& operator=(const StatsReader&) = delete;

  std::size_t count() const { return count_; }
  LightFieldDepthStats newest() const;
  /// What the frames since the last call had, and the longest times of one of them.
  struct Times
  {
    std::vector<double> latency_ms;
    double longest_computing_ms = 0.0;
    bool all_views = true;  ///< each frame had every view
  };
  Times takeTimes();

private:
  void add(const LightFieldDepthStatsConstPtr& stats);

  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_{1, &queue_};
  mutable std::mutex mutex_;
  LightFieldDepthStats newest_;
  Times times_;
  std::atomic<std::size_t> count_{0};
  ros::Subscriber subscriber_;
};

/// A result that somebody listens to and does nothing with.
ros::Subscriber listenTo(ros::NodeHandle node_space, const std::string& result);

/// This program as a manager of nodelets, and depth nodelets in it.
class LoadFixture : public ::testing::Test
{
protected:
  void SetUp() override { spinner_.start(); }
  void TearDown() override
  {
    loader_.clear();
    spinner_.stop();
  }

  /// Loads the depth nodelet NAME/depth for an array of rows x columns in the namespace NAME.
  bool load(const std::string& name, int rows, int columns);
  bool unload(const std::string& name) { return loader_.unload(name + "/depth"); }

  ros::AsyncSpinner spinner_{2};
  nodelet::Loader loader_{ros::NodeHandle("~")};
};

/// Publishes sets at a rate until it is destroyed, by a thread of its own.
class Flood
{
public:
  Flood(DriverArray& array, double rate_hz);
  ~Flood();
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

  /// Ends it. @return the stamp of the last set
  ros::Time stop();
  std::uint64_t sets() const { return sets_; }

private:
  DriverArray& array_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::uint64_t> sets_{0};
  ros::Time stamp_;
  std::thread thread_;
};

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_ROSTEST_LOAD_FIXTURE_H
