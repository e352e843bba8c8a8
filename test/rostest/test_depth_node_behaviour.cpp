#include <algorithm>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <std_srvs/Empty.h>
#include <stereo_msgs/DisparityImage.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth::testing
{
namespace
{
using DepthNodeTest = ArrayFixture;
using DisparityListener = Listener<stereo_msgs::DisparityImage>;
using StatsListener = Listener<LightFieldDepthStats>;

const cv::Size SMALL(64, 48);

template <class Value>
void add(std::vector<Value>& values, const std::string& name, const decltype(Value::value)& value)
{
  Value entry;
  entry.name = name;
  entry.value = value;
  values.push_back(entry);
}

/// Sends a change to the node; returns the values that are then in force.
dynamic_reconfigure::Config reconfigure(const ros::NodeHandle& node,
                                        const dynamic_reconfigure::Config& change)
{
  dynamic_reconfigure::Reconfigure call;
  call.request.config = change;
  EXPECT_TRUE(ros::service::call(node.resolveName("set_parameters"), call));
  return call.response.config;
}

double valueOf(const dynamic_reconfigure::Config& config, const std::string& name)
{
  for (const auto& entry : config.doubles)
  {
    if (entry.name == name)
    {
      return entry.value;
    }
  }
  ADD_FAILURE() << "no value of " << name;
  return 0.0;
}

TEST_F(DepthNodeTest, ChangesItsSettingsInMidStream)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  dynamic_reconfigure::Config change;
  add(change.strs, "views", "row");
  reconfigure(*node_space_, change);
  EXPECT_TRUE(publishUntil(array, [&] { return stats.count() > 0 && stats.newest()->views_used == 3; }));
  change.strs.clear();
  add(change.strs, "views", "all");
  reconfigure(*node_space_, change);
  EXPECT_TRUE(publishUntil(array, [&] { return stats.newest()->views_used == 9; }));
}

TEST_F(DepthNodeTest, ReportsCoercedAndRefusedValuesBack)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  startNode(scene.light_field);
  dynamic_reconfigure::Config change;
  add(change.doubles, "min_confidence", 7.0);
  EXPECT_DOUBLE_EQ(valueOf(reconfigure(*node_space_, change), "min_confidence"), 1.0)
      << "coerced to its limit";
  dynamic_reconfigure::Config impossible;
  dynamic_reconfigure::BoolParameter automatic;
  automatic.name = "disparity_range_auto";
  automatic.value = 0;
  impossible.bools.push_back(automatic);
  add(impossible.doubles, "disparity_min", 5.0);
  add(impossible.doubles, "disparity_max", -5.0);
  const dynamic_reconfigure::Config answer = reconfigure(*node_space_, impossible);
  EXPECT_LT(valueOf(answer, "disparity_min"), valueOf(answer, "disparity_max"))
      << "refused: the old values hold";
  EXPECT_DOUBLE_EQ(valueOf(answer, "min_confidence"), 1.0);
}

TEST_F(DepthNodeTest, NamesAViewThatNeverComes)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 0.5);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  const auto without_last = [](std::size_t view) { return view != 2; };
  const bool told = waitFor(
      [&]
      {
        array.publishInfos(nextStamp(), without_last);
        array.publishImages(stamp_, without_last);
        return diagnosed(diagnostics, {"View (0, 2)", "no image", "view_0_2/image_rect_color"});
      });
  EXPECT_TRUE(told);
  EXPECT_EQ(disparity.count(), 0U);
  EXPECT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; })) << "recovers when it does come";
}

TEST_F(DepthNodeTest, PublishesNothingFromAContradictoryCameraInfo)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  array.info(1).P[0] = 0.0;
  EXPECT_TRUE(publishUntil(array, [&] { return diagnosed(diagnostics, {"View (0, 1)", "P[0]"}); }));
  EXPECT_EQ(disparity.count(), 0U);
  array.info(1).P[0] = array.info(0).P[0];
  EXPECT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; })) << "recovers once it is right";
}

TEST_F(DepthNodeTest, PublishesNothingFromImagesThatDoNotFit)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  const sensor_msgs::Image good = array.image(2);
  array.image(2).height = 40;
  EXPECT_TRUE(publishUntil(array, [&] { return diagnosed(diagnostics, {"View (0, 2)", "64 x 40"}); }));
  array.image(2) = good;
  array.image(2).data.resize(100);
  EXPECT_TRUE(publishUntil(array, [&] { return diagnosed(diagnostics, {"View (0, 2)", "truncated"}); }));
  array.image(2) = good;
  array.image(2).encoding = "32FC1";
  EXPECT_TRUE(publishUntil(array, [&] { return diagnosed(diagnostics, {"View (0, 2)", "32FC1"}); }));
  EXPECT_EQ(disparity.count(), 0U);
}

TEST_F(DepthNodeTest, KeepsASetUntilItsCameraInfoHasCome)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  const ros::Time stamp = nextStamp();
  array.publishImages(stamp, [](std::size_t) { return true; });
  array.publishInfos(stamp, [](std::size_t view) { return view != 1; });
  array.publishInfos(stamp, [](std::size_t view) { return view == 1; });
  ASSERT_TRUE(waitFor([&] { return disparity.count() > 0; }));
  EXPECT_EQ(disparity.newest()->header.stamp, stamp);
}

TEST_F(DepthNodeTest, TellsOfACameraInfoThatNeverComes)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 0.5);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(waitFor(
      [&]
      {
        array.publishImages(nextStamp(), [](std::size_t) { return true; });
        array.publishInfos(stamp_, [](std::size_t view) { return view != 0; });
        return diagnosed(diagnostics, {"View (0, 0)", "no CameraInfo", "view_0_0/camera_info"});
      }));
  EXPECT_EQ(disparity.count(), 0U);
}

TEST_F(DepthNodeTest, WorksWithoutCameraInfoFromParameters)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("use_camera_info", false);
  setParameter("focal_length", 80.0);
  setParameter("baseline_x", 0.2);
  setParameter("disparity_offset", 6.0);
  setParameter("frame_id", std::string("given_frame"));
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == 3; })) << "images only";
  array.publishImages(nextStamp(), [](std::size_t) { return true; });
  ASSERT_TRUE(waitFor([&] { return disparity.count() > 0; }));
  EXPECT_FLOAT_EQ(disparity.newest()->f, 80.0F);
  EXPECT_FLOAT_EQ(disparity.newest()->T, 0.2F);
  EXPECT_EQ(disparity.newest()->header.frame_id, "given_frame");
}

TEST_F(DepthNodeTest, GoesOnAfterTheClockHasJumpedBack)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 2; }));
  stamp_ = ros::Time(1.0);
  EXPECT_TRUE(publishUntil(array, [&] { return stats.newest()->header.stamp < ros::Time(50.0); }));
  EXPECT_EQ(stats.newest()->time_jumps, 1U);
}

TEST_F(DepthNodeTest, TakesStampsWithinTheTolerance)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("sync_tolerance", 0.003);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  const ros::Time stamp = nextStamp();
  array.publishInfos(stamp, [](std::size_t) { return true; });
  for (std::size_t i = 0; i < 3; ++i)
  {
    array.publishImages(stamp + ros::Duration(0.001 * static_cast<double>(i)),
                        [i](std::size_t view) { return view == i; });
  }
  ASSERT_TRUE(waitFor([&] { return stats.count() > 0; }));
  EXPECT_NEAR(stats.newest()->stamp_spread_ms, 2.0, 1e-3);
}

TEST_F(DepthNodeTest, WorksOnEverySetWhenAskedTo)
{
  constexpr std::size_t FRAMES = 12;
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), {128, 96});
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("keep_all", true);
  setParameter("queue_size", 20);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  for (std::size_t i = 0; i < FRAMES; ++i)
  {
    array.publish(nextStamp());
  }
  EXPECT_TRUE(waitFor([&] { return disparity.count() == FRAMES; })) << disparity.count();
}

TEST_F(DepthNodeTest, ForgetsOnReset)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; }));
  std_srvs::Empty call;
  ASSERT_TRUE(ros::service::call(node_space_->resolveName("reset"), call));
  const std::size_t before = disparity.count();
  EXPECT_TRUE(publishUntil(array, [&] { return disparity.count() > before; }));
}

TEST_F(DepthNodeTest, IsDestroyedInMidFrameWithoutWaitingForIt)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), {512, 512});
  ArrayPublisher array(*array_space_, scene.light_field);
  std::vector<double> milliseconds;
  for (int round = 0; round < 5; ++round)
  {
    startNode(scene.light_field);
    const StatsListener stats(*node_space_, "stats");
    ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
    array.publish(nextStamp());
    // Different instants inside the frame, which takes longer than all of them.
    EXPECT_FALSE(waitFor([&] { return stats.count() > 0; }, std::chrono::milliseconds(10 * round)));
    const auto start = std::chrono::steady_clock::now();
    node_.reset();
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  // The median, so that a busy machine does not decide.
  std::nth_element(milliseconds.begin(), milliseconds.begin() + 2, milliseconds.end());
  EXPECT_LT(milliseconds[2], 200.0);
}

TEST_F(DepthNodeTest, RefusesParametersBeforeItAdvertisesAnything)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  setParameter("queue_size", std::string("many"));
  EXPECT_THROW(startNode(scene.light_field), InputError);
  setParameter("queue_size", 0);
  EXPECT_THROW(startNode(scene.light_field), InputError);
  setParameter("queue_size", 5);
  setParameter("image_transport", std::string("no_such_transport"));
  EXPECT_THROW(startNode(scene.light_field), InputError);
  setParameter("lazy", false);
  EXPECT_THROW(startNode(scene.light_field), InputError);
  setParameter("image_transport", std::string("raw"));
  setParameter("use_camera_info", false);
  setParameter("focal_length", 80.0);
  EXPECT_THROW(startNode(scene.light_field), InputError) << "no baseline";
  const ros::V_string advertised = []
  {
    ros::V_string topics;
    ros::this_node::getAdvertisedTopics(topics);
    return topics;
  }();
  for (const std::string& topic : advertised)
  {
    EXPECT_EQ(topic.find(node_space_->getNamespace()), std::string::npos) << topic;
  }
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_depth_node_behaviour");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
