#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace
{
/// What a command prints, and whether it succeeded.
struct Outcome
{
  bool success = false;
  std::string output;
};

Outcome run(const std::string& command)
{
  Outcome outcome;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  while (pipe != nullptr && std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr)
  {
    outcome.output += buffer.data();
  }
  outcome.success = pipe != nullptr && pclose(pipe) == 0;
  return outcome;
}

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
    const Outcome outcome = run("roslaunch --nodes " + entry.path().string() + " " + launch.arguments);
    EXPECT_TRUE(outcome.success) << outcome.output;
    EXPECT_NE(outcome.output.find(launch.node), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("/light_field_depth"), std::string::npos) << outcome.output;
    ++files;
  }
  EXPECT_EQ(files, launches.size());
}

TEST(LaunchFiles, StartAManagerOnlyWhenNoneIsNamed)
{
  EXPECT_NE(run("roslaunch --nodes launch/depth.launch").output.find("/light_field_manager"),
            std::string::npos);
  EXPECT_EQ(run("roslaunch --nodes launch/depth.launch manager:=/mine").output.find("/light_field_manager"),
            std::string::npos);
}

TEST(LaunchFiles, AnArrayIsAStreamAndABagASeriesOfFrames)
{
  const std::string on = "/light_field_depth/multiview_temporal: true";
  EXPECT_NE(run("roslaunch --dump-params launch/depth.launch").output.find(on), std::string::npos);
  EXPECT_EQ(run("roslaunch --dump-params launch/depth.launch temporal:=false").output.find(on),
            std::string::npos);
  EXPECT_EQ(run("roslaunch --dump-params launch/replay.launch bag:=file.bag").output.find(on),
            std::string::npos);
}

}  // namespace
