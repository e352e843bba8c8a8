// A nodelet manager that is killed: the launch file starts it again, and the nodelet in it.

#include <csignal>
#include <string>

#include <gtest/gtest.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

namespace light_field_depth::testing
{
namespace
{
/// The process of a node, as the node itself says; 0 when it does not answer.
pid_t processOf(const std::string& node)
{
  XmlRpc::XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", arguments, response, uri, false) ||
      !ros::network::splitURI(static_cast<std::string&>(uri), host, port))
  {
    return 0;
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue answer;
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  const bool answered = client.execute("getPid", caller, answer) &&
                        answer.getType() == XmlRpc::XmlRpcValue::TypeArray && answer.size() == 3;
  return answered ? static_cast<int>(answer[2]) : 0;
}

TEST(Respawn, OfAKilledManagerBringsTheResultsBack)
{
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), {64, 48});
  ArrayPublisher array(ros::NodeHandle("/"), scene.light_field);
  const Listener<LightFieldDepthStats> stats(ros::NodeHandle("/light_field_depth"), "stats");
  const auto publish_until = [&](const std::function<bool()>& condition)
  {
    return waitFor(
        [&]
        {
          array.publish(ros::Time::now());
          return waitFor(condition, std::chrono::milliseconds(50));
        },
        std::chrono::seconds(60));
  };
  ASSERT_TRUE(publish_until([&] { return stats.count() > 0; }));
  const pid_t manager = processOf("/light_field_depth_manager");
  ASSERT_GT(manager, 0);
  ASSERT_EQ(kill(manager, SIGKILL), 0);
  const auto killed_at = ros::Time::now();
  EXPECT_TRUE(publish_until([&] { return stats.newest()->header.stamp > killed_at + ros::Duration(0.5); }));
  EXPECT_NE(processOf("/light_field_depth_manager"), manager);
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_respawn");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
