// Sets spread over workers, results in order.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <stereo_msgs/DisparityImage.h>
#include <opencv2/imgcodecs.hpp>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/ros/distributor_node.h"

namespace light_field_depth::testing
{
namespace
{
using DisparityListener = Listener<stereo_msgs::DisparityImage>;
using StatsListener = Listener<LightFieldDepthStats>;

class DistributedTest : public ::testing::Test
{
protected:
  void SetUp() override { spinner_.start(); }
  void TearDown() override { spinner_.stop(); }

  /// A depth node in the namespace of a worker; its array is that of the distributor.
  static std::unique_ptr<DepthNode> startWorker(int number, const std::string& distributor = "/spread")
  {
    const ros::NodeHandle space("/worker_" + std::to_string(number));
    const ros::NodeHandle node_space(space, "light_field_depth");
    XmlRpc::XmlRpcValue array;
    EXPECT_TRUE(ros::param::get(distributor + "/array", array));
    node_space.setParam("array", array);
    node_space.setParam("keep_all", true);
    node_space.setParam("threads", 1);
    return std::make_unique<DepthNode>(space, node_space);
  }

  /// Publishes a set. @return its stamp
  ros::Time publish(ArrayPublisher& array)
  {
    stamp_ += ros::Duration(0.1);
    array.publish(stamp_);
    return stamp_;
  }

  /// Sets until results come: the topics find each other one by one.
  bool runUntil(ArrayPublisher& array, const std::function<bool()>& condition)
  {
    return waitFor(
        [&]
        {
          publish(array);
          return waitFor(condition, std::chrono::milliseconds(200));
        });
  }

  ros::AsyncSpinner spinner_{4};
  ros::NodeHandle root_{"/"};
  ros::NodeHandle private_{"/spread"};
  ros::Time stamp_{100.0};
};

void expectRisingStamps(const std::vector<stereo_msgs::DisparityImageConstPtr>& results)
{
  for (std::size_t i = 1; i < results.size(); ++i)
  {
    EXPECT_GT(results[i]->header.stamp, results[i - 1]->header.stamp) << i;
  }
}

/// @return the share of valid pixels
double expectResultOf(const LightField& light_field, const stereo_msgs::DisparityImage& result)
{
  Pipeline pipeline(1);
  const cv::Mat expected = pipeline.run(light_field, {}, {}).estimate.disparity +
                           static_cast<float>(light_field.calibration->disparity_offset_px);
  const cv::Mat values(static_cast<int>(result.image.height), static_cast<int>(result.image.width), CV_32FC1,
                       const_cast<std::uint8_t*>(result.image.data.data()), result.image.step);
  const cv::Mat valid = values >= result.min_disparity;
  cv::Mat difference;
  cv::absdiff(values, expected, difference);
  double largest = 0.0;
  cv::minMaxLoc(difference, nullptr, &largest, nullptr, nullptr, valid);
  EXPECT_EQ(largest, 0.0);
  return cv::countNonZero(valid) / static_cast<double>(valid.total());
}

TEST_F(DistributedTest, MasksGoToTheWorkers)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3));
  private_ = ros::NodeHandle("/spread_masked");
  XmlRpc::XmlRpcValue array_parameter;
  array_parameter["rows"] = 1;
  array_parameter["columns"] = 3;
  array_parameter["mask_topic"] = std::string("view_{row}_{column}/mask");
  private_.setParam("array", array_parameter);
  private_.setParam("workers", std::vector<std::string>{"/worker_3"});
  const std::unique_ptr<DepthNode> worker = startWorker(3, "/spread_masked");
  DistributorNode distributor(root_, private_);
  ArrayPublisher array(root_, scene.light_field);
  // Black wedges at the sides, of another width in each view.
  LightField masked = scene.light_field;
  std::vector<ros::Publisher> publishers;
  for (std::size_t view = 0; view < masked.views.size(); ++view)
  {
    cv::Mat mask(masked.size(), CV_8UC1, cv::Scalar(255));
    mask.colRange(0, 12 + 6 * static_cast<int>(view)).setTo(0);
    masked.views[view].mask = mask;
    publishers.push_back(
        root_.advertise<sensor_msgs::Image>("view_0_" + std::to_string(view) + "/mask", 1, true));
    publishers.back().publish(*cv_bridge::CvImage(std_msgs::Header(), "mono8", mask).toImageMsg());
  }
  const DisparityListener results(private_, "disparity");
  // The first sets may be without the masks, which come on their own.
  const auto leaves_wedge_out = [&]
  {
    if (results.count() == 0)
    {
      return false;
    }
    const stereo_msgs::DisparityImageConstPtr result = results.newest();
    const auto* const row =
        reinterpret_cast<const float*>(result->image.data.data() + 30 * result->image.step);
    return row[8] < result->min_disparity;
  };
  ASSERT_TRUE(runUntil(array, leaves_wedge_out));
  const double valid = expectResultOf(masked, *results.newest());
  EXPECT_GT(valid, 0.5);
  EXPECT_LT(valid, 0.9);
}

TEST_F(DistributedTest, TwoWorkersGiveTheBitsOfOneNodeInOrderAndOneMayDie)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3));
  ArrayPublisher array(root_, scene.light_field);
  const StatsListener first_stats(root_, "/worker_0/light_field_depth/stats");
  const StatsListener second_stats(root_, "/worker_1/light_field_depth/stats");
  std::unique_ptr<DepthNode> first = startWorker(0);
  std::unique_ptr<DepthNode> second = startWorker(1);
  DistributorNode distributor(root_, private_);
  const DisparityListener results(private_, "disparity");
  ASSERT_TRUE(runUntil(
      array, [&] { return results.count() > 5 && first_stats.count() > 1 && second_stats.count() > 1; }))
      << results.count() << " results, " << first_stats.count() << " and " << second_stats.count() << " sets";

  EXPECT_GT(expectResultOf(scene.light_field, *results.newest()), 0.5);

  second.reset();
  const std::size_t before = results.count();
  EXPECT_TRUE(runUntil(array, [&] { return results.count() > before + 3; })) << "the other one goes on";
  second = startWorker(1);
  const std::size_t of_second = second_stats.count();
  EXPECT_TRUE(runUntil(array, [&] { return second_stats.count() > of_second + 1; })) << "it is used again";
  expectRisingStamps(results.all());
}

TEST_F(DistributedTest, CompressedViewsStayCompressedOnTheirWay)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3));
  private_ = ros::NodeHandle("/spread_compressed");
  XmlRpc::XmlRpcValue array;
  ASSERT_TRUE(ros::param::get("/spread/array", array));
  private_.setParam("array", array);
  private_.setParam("workers", std::vector<std::string>{"/worker_2"});
  private_.setParam("image_transport", std::string("compressed"));
  ros::param::set("/worker_2/light_field_depth/image_transport", std::string("compressed"));
  const std::unique_ptr<DepthNode> worker = startWorker(2);
  DistributorNode distributor(root_, private_);
  ArrayPublisher infos(root_, scene.light_field, true);
  std::vector<ros::Publisher> publishers;
  std::vector<sensor_msgs::CompressedImage> images(3);
  for (std::size_t view = 0; view < images.size(); ++view)
  {
    publishers.push_back(root_.advertise<sensor_msgs::CompressedImage>(
        "view_0_" + std::to_string(view) + "/image_rect_color/compressed", 5));
    images[view].format = "bgr8; png compressed bgr8";
    cv::imencode(".png", scene.light_field.views[view].image, images[view].data);
  }
  infos.publishInfos(stamp_, [](std::size_t) { return true; });
  const DisparityListener disparity(private_, "disparity");
  const Listener<sensor_msgs::CameraInfo> info(private_, "right/camera_info");
  EXPECT_TRUE(waitFor(
      [&]
      {
        stamp_ += ros::Duration(0.1);
        for (std::size_t view = 0; view < images.size(); ++view)
        {
          images[view].header.stamp = stamp_;
          publishers[view].publish(images[view]);
        }
        return waitFor([&] { return disparity.count() > 0 && info.count() > 0; },
                       std::chrono::milliseconds(200));
      }));
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_distributor_node");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
