#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "support/program.h"

namespace
{
using light_field_depth::testing::Outcome;
using light_field_depth::testing::runProgram;

/// What has to be said of a launch file, and a node that it then starts.
struct Launch
{
  std::string arguments;
  std::string node;
};

TEST(LaunchFiles, AllLoad)
{
  const std::map<std::string, Launch> launches = {
      {"depth.launch", {"array:=grid_3x3 rviz:=true method:=paper2017 views:=cross", "/rviz"}},
      {"play.launch", {"input:=folder manager:=/other", "/light_field_player"}},
      {"replay.launch", {"bag:=file.bag loop:=true use_sim_time:=false", "/rosbag_play"}},
      {"demo.launch", {"bag:=file.bag", "/optical_frame_broadcaster"}},
  };
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("launch"))
  {
    const std::string name = entry.path().filename().string();
    ASSERT_EQ(launches.count(name), 1U) << "no test of " << name;
    const Launch& launch = launches.at(name);
    const Outcome outcome = runProgram("roslaunch --nodes " + entry.path().string() + " " + launch.arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find(launch.node), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("/light_field_depth"), std::string::npos) << outcome.output;
    ++files;
  }
  EXPECT_EQ(files, launches.size());
}

TEST(LaunchFiles, StartAManagerOnlyWhenNoneIsNamed)
{
  EXPECT_NE(runProgram("roslaunch --nodes launch/depth.launch").output.find("/light_field_manager"),
            std::string::npos);
  EXPECT_EQ(
      runProgram("roslaunch --nodes launch/depth.launch manager:=/mine").output.find("/light_field_manager"),
      std::string::npos);
}

/// What roslaunch would start a node with.
std::string commandOf(const std::string& node, const std::string& launch)
{
  return runProgram("roslaunch --args " + node + " launch/" + launch).output;
}

TEST(LaunchFiles, TakePathsWithSpacesAndApostrophes)
{
  // roslaunch joins the words with single spaces, so a path that it had split would have lost one.
  const std::string path = "/tmp/it's  my/views";
  const std::string quoted = light_field_depth::testing::quoted(path);
  const auto expect = [&](const std::string& command)
  { EXPECT_NE(command.find(" " + path + " "), std::string::npos) << command; };
  expect(commandOf("/light_field_player", "play.launch input:=" + quoted));
  expect(commandOf("/rosbag_play", "replay.launch bag:=" + quoted));
  expect(commandOf("/rosbag_play", "demo.launch bag:=" + quoted));
  expect(commandOf("/rviz", "depth.launch rviz:=true rviz_config:=" + quoted));
}

TEST(LaunchFiles, HandThePresetToTheNode)
{
  const std::string parameter = "/light_field_depth/multiview_preset: ";
  for (const std::string launch :
       {"depth.launch", "play.launch input:=x", "replay.launch bag:=x", "demo.launch bag:=x"})
  {
    const std::string command = "roslaunch --dump-params launch/" + launch;
    EXPECT_NE(runProgram(command + " preset:=realtime").output.find(parameter + "realtime"),
              std::string::npos)
        << launch;
    EXPECT_EQ(runProgram(command).output.find(parameter), std::string::npos)
        << launch << ": the default is the node's";
  }
}

TEST(LaunchFiles, AnArrayIsAStreamAndABagASeriesOfFrames)
{
  const std::string on = "/light_field_depth/multiview_temporal: true";
  EXPECT_NE(runProgram("roslaunch --dump-params launch/depth.launch").output.find(on), std::string::npos);
  EXPECT_EQ(runProgram("roslaunch --dump-params launch/depth.launch temporal:=false").output.find(on),
            std::string::npos);
  EXPECT_EQ(runProgram("roslaunch --dump-params launch/replay.launch bag:=file.bag").output.find(on),
            std::string::npos);
}

}  // namespace
