#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>
#include <topic_tools/shape_shifter.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/ros/image_conversion.h"

namespace light_field_depth::testing
{
namespace
{
using DepthNodeTest = ArrayFixture;
using DisparityListener = Listener<stereo_msgs::DisparityImage>;
using ImageListener = Listener<sensor_msgs::Image>;
using CloudListener = Listener<sensor_msgs::PointCloud2>;
using StatsListener = Listener<LightFieldDepthStats>;

cv::Mat floats(const sensor_msgs::Image& image)
{
  EXPECT_EQ(image.encoding, "32FC1");
  return cv::Mat(static_cast<int>(image.height), static_cast<int>(image.width), CV_32FC1,
                 const_cast<std::uint8_t*>(image.data.data()), image.step)
      .clone();
}

std::vector<ColoredPoint> pointsOf(const sensor_msgs::PointCloud2& cloud)
{
  EXPECT_EQ(cloud.point_step, sizeof(ColoredPoint));
  std::vector<ColoredPoint> points(static_cast<std::size_t>(cloud.width) * cloud.height);
  EXPECT_EQ(cloud.data.size(), points.size() * sizeof(ColoredPoint));
  std::memcpy(points.data(), cloud.data.data(), cloud.data.size());
  return points;
}

TEST_F(DepthNodeTest, PublishesDisparityDepthAndCloudsOfASyntheticArray)
{
  const SyntheticLightField scene = syntheticArray(crossPositions(5, 5));
  const Calibration& calibration = *scene.light_field.calibration;
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const ImageListener depth(*node_space_, "depth");
  const ImageListener confidence(*node_space_, "confidence");
  const CloudListener points2(*node_space_, "points2");
  const CloudListener points_dense(*node_space_, "points_dense");
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(publishUntil(array,
                           [&]
                           {
                             return disparity.count() > 0 && depth.count() > 0 && confidence.count() > 0 &&
                                    points2.count() > 0 && points_dense.count() > 0 && stats.count() > 0;
                           }));

  const auto& image = *disparity.newest();
  EXPECT_EQ(image.header.frame_id, "array_optical_frame");
  EXPECT_EQ(image.image.header.stamp, image.header.stamp);
  EXPECT_FLOAT_EQ(image.f, static_cast<float>(calibration.focal_length_px));
  EXPECT_FLOAT_EQ(image.T, static_cast<float>(calibration.baseline_m));
  EXPECT_EQ(image.valid_window.width, 96U);
  EXPECT_EQ(image.valid_window.height, 72U);
  const cv::Mat absolute = floats(image.image);
  EXPECT_LT(meanAbsoluteError(absolute - calibration.disparity_offset_px, scene.truth), 0.6);
  const PipelineResult direct = Pipeline().run(scene.light_field, {}, {});
  EXPECT_LT(cv::norm(absolute - calibration.disparity_offset_px, direct.estimate.disparity, cv::NORM_INF),
            1e-4)
      << "the node adds nothing to what the pipeline finds";

  // What any consumer of stereo disparities makes of it is the depth that is published.
  const cv::Mat z = floats(*depth.newest());
  for (const cv::Point pixel : {cv::Point(20, 20), cv::Point(48, 36), cv::Point(80, 60)})
  {
    EXPECT_NEAR(image.f * image.T / absolute.at<float>(pixel), z.at<float>(pixel), 1e-4);
  }

  const auto& organized = *points2.newest();
  EXPECT_EQ(organized.width, 96U);
  EXPECT_EQ(organized.height, 72U);
  EXPECT_FALSE(organized.is_dense);
  EXPECT_NEAR(pointsOf(organized)[36 * 96 + 48].z, z.at<float>(36, 48), 1e-4);

  const auto& dense = *points_dense.newest();
  EXPECT_EQ(dense.height, 1U);
  EXPECT_TRUE(dense.is_dense);
  for (const ColoredPoint& point : pointsOf(dense))
  {
    ASSERT_TRUE(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
  }

  const auto& report = *stats.newest();
  EXPECT_EQ(report.views_expected, 9U);
  EXPECT_EQ(report.method, toString(PipelineOptions().method));
  EXPECT_GT(report.latency_ms, 0.0);
  EXPECT_GE(report.latency_ms, report.pipeline_ms);
  EXPECT_EQ(report.received_by_view.size(), 9U);
  EXPECT_EQ(report.frames_failed, 0U);
  EXPECT_EQ(report.stage_names.size(), report.stage_ms.size());
}

TEST_F(DepthNodeTest, PublishesDisparityWhileADenseCloudIsMade)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(5, 5), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("dense_maps", 9);  // eight more than the disparity takes
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const CloudListener points_dense(*node_space_, "points_dense");
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  const bool skipped = waitFor(
      [&]
      {
        const std::size_t before = stats.count();
        array.publish(nextStamp());
        return waitFor([&] { return stats.count() > before; }) && stats.newest()->dense_clouds_skipped > 0;
      });
  ASSERT_TRUE(skipped) << "a frame is published while the cloud of another is made";
  EXPECT_EQ(stats.newest()->frames_dropped, 0U) << "it is no dropped set";
  EXPECT_TRUE(waitFor([&] { return disparity.count() >= stats.count(); })) << "nor without disparity";
  ASSERT_TRUE(waitFor([&] { return points_dense.count() > 0; })) << "the cloud comes all the same";
  const auto stamps = disparity.all();
  const ros::Time made = points_dense.all().front()->header.stamp;
  EXPECT_TRUE(std::any_of(stamps.begin(), stamps.end(),
                          [&](const auto& message) { return message->header.stamp == made; }));
  const std::uint64_t clouds = points_dense.count();
  EXPECT_TRUE(publishUntil(array, [&] { return stats.newest()->dense_clouds_published >= clouds; }));
  EXPECT_GT(stats.newest()->dense_cloud_latency_ms, 0.0);
}

class DepthNodeSizes : public ArrayFixture, public ::testing::WithParamInterface<int>
{
};
INSTANTIATE_TEST_SUITE_P(Sides, DepthNodeSizes, ::testing::Values(9, 17));

TEST_P(DepthNodeSizes, WorksOnAFullGrid)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(GetParam(), GetParam()), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  array.publish(nextStamp());
  ASSERT_TRUE(waitFor([&] { return stats.count() > 0; }));
  EXPECT_EQ(stats.newest()->views_expected, static_cast<std::uint32_t>(GetParam() * GetParam()));
  EXPECT_EQ(stats.newest()->sets_incomplete, 0U);
}

TEST_F(DepthNodeTest, ListensToTheViewsOnlyWhileSomebodyListensToIt)
{
  const SyntheticLightField scene = syntheticArray(crossPositions(3, 3), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  EXPECT_EQ(array.topicsHeard(), 0U);
  for (const char* const topic : {"disparity", "points_dense", "stats"})
  {
    {
      const Listener<topic_tools::ShapeShifter> listener(*node_space_, topic);
      EXPECT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); })) << topic;
      EXPECT_TRUE(publishUntil(array, [&] { return listener.count() > 0; })) << topic;
    }
    EXPECT_TRUE(waitFor([&] { return array.topicsHeard() == 0; })) << topic;
  }
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_depth_node");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
