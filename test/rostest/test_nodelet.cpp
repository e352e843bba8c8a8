#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <sensor_msgs/Image.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

// The nodelet in a manager, which the launch file starts: /manager, with the parameters of /depth and
// /broken.
namespace light_field_depth::testing
{
namespace
{
const char* const NODELET = "light_field_depth/DepthNodelet";

bool load(const std::string& name, const std::string& type = NODELET)
{
  nodelet::NodeletLoad call;
  call.request.name = name;
  call.request.type = type;
  return ros::service::call("/manager/load_nodelet", call) && call.response.success != 0;
}

bool unload(const std::string& name)
{
  nodelet::NodeletUnload call;
  call.request.name = name;
  return ros::service::call("/manager/unload_nodelet", call) && call.response.success != 0;
}

/// Whether the manager answers and has the nodelet.
bool has(const std::string& name)
{
  nodelet::NodeletList call;
  EXPECT_TRUE(ros::service::call("/manager/list", call)) << "the manager is gone";
  const auto& names = call.response.nodelets;
  return std::find(names.begin(), names.end(), name) != names.end();
}

class NodeletTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", ros::Duration(30)));
    spinner_.start();
  }
  void TearDown() override { spinner_.stop(); }

  ros::AsyncSpinner spinner_{2};
  ros::NodeHandle root_{"/"};
  ros::NodeHandle node_{"/depth"};
};

TEST_F(NodeletTest, IsUnloadedInMidFrameTwentyTimesInARow)
{
  constexpr int ROUNDS = 20;
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), {384, 384});
  ArrayPublisher array(root_, scene.light_field);
  std::vector<double> milliseconds;
  for (int round = 0; round < ROUNDS; ++round)
  {
    ASSERT_TRUE(load("/depth"));
    const Listener<LightFieldDepthStats> stats(node_, "stats");
    ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
    array.publish(ros::Time(1.0 + round));
    // Different instants, so that every stage is met.
    waitFor([&] { return stats.count() > 0; }, std::chrono::milliseconds(10 * round));
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(unload("/depth"));
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    EXPECT_FALSE(has("/depth"));
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  RecordProperty("median_ms", std::to_string(milliseconds[ROUNDS / 2]));
  RecordProperty("longest_ms", std::to_string(milliseconds.back()));
  EXPECT_LT(milliseconds[ROUNDS / 2], 200.0) << "the median, so that a busy machine does not decide";
}

TEST_F(NodeletTest, WorksAfterAllThat)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), {64, 48});
  ArrayPublisher array(root_, scene.light_field);
  ASSERT_TRUE(load("/depth"));
  const Listener<LightFieldDepthStats> stats(node_, "stats");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  int frame = 0;
  EXPECT_TRUE(waitFor(
      [&]
      {
        array.publish(ros::Time(100.0 + ++frame));
        return waitFor([&] { return stats.count() > 0; }, std::chrono::milliseconds(100));
      }));
  EXPECT_TRUE(unload("/depth"));
}

TEST_F(NodeletTest, LeavesTheManagerUpWhenItsParametersCannotBeUsed)
{
  load("/broken");
  EXPECT_FALSE(has("/depth"));
  has("/broken");  // answers: the manager is up
  ASSERT_TRUE(load("/depth")) << "and takes other nodelets";
  EXPECT_TRUE(has("/depth"));
  EXPECT_TRUE(unload("/depth"));
}

TEST_F(NodeletTest, OneImageIsSplitIntoTheTopicsOfTheViews)
{
  ASSERT_TRUE(load("/splitter", "light_field_depth/TileSplitterNodelet"));
  ros::Publisher publisher = root_.advertise<sensor_msgs::Image>("image", 1);
  {
    const Listener<sensor_msgs::Image> first(root_, "tile_0_0");
    const Listener<sensor_msgs::Image> last(root_, "tile_1_2");
    ASSERT_TRUE(waitFor([&] { return publisher.getNumSubscribers() > 0; }));
    sensor_msgs::Image image;
    image.header.stamp = ros::Time(7.0);
    image.encoding = "mono8";
    image.width = image.step = 48;
    image.height = 32;
    image.data.resize(48 * 32);
    for (std::size_t i = 0; i < image.data.size(); ++i)
    {
      image.data[i] = static_cast<std::uint8_t>(i % 251);
    }
    publisher.publish(image);
    ASSERT_TRUE(waitFor([&] { return first.count() > 0 && last.count() > 0; }));
    EXPECT_EQ(last.newest()->header.stamp, image.header.stamp);
    EXPECT_EQ(last.newest()->width, 16U);
    EXPECT_EQ(last.newest()->height, 16U);
    EXPECT_EQ(last.newest()->data[0], image.data[16 * 48 + 32]);
  }
  EXPECT_TRUE(waitFor([&] { return publisher.getNumSubscribers() == 0; })) << "nobody listens any more";
  EXPECT_TRUE(unload("/splitter"));
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_nodelet");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
