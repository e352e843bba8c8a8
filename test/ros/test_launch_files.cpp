#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::Outcome;
using testing::runProgram;

/// What has to be said of a launch file, and a node that it then starts.
struct Launch
{
  std::string arguments;
  std::string node;
};

TEST(LaunchFiles, AllLoad)
{
  const std::map<std::string, Launch> launches = {
      {"depth.launch",
       {"array:=grid_3x3 rviz:=true method:=paper2017 views:=cross", "/light_field_depth/rviz"}},
      {"play.launch", {"input:=folder manager:=/other", "/light_field_player"}},
      {"replay.launch", {"bag:=file.bag loop:=true use_sim_time:=false", "/rosbag_play"}},
      {"rectified_array.launch", {"rows:=1 columns:=5", "/rectify_view_0_4"}},
      {"array.launch", {"array:=row_1x5 record:=file.bag", "/robot_state_publisher"}},
      {"distributed.launch", {"workers:=3 array:=grid_3x3", "/worker_2/light_field_depth"}},
      {"demo.launch", {"bag:=file.bag", "/upright_frame_broadcaster"}},
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

std::string parametersOf(const std::string& launch)
{
  const Outcome outcome = runProgram("roslaunch --dump-params launch/" + launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  return outcome.output;
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// The arguments of a launch file by their names, each with its line.
std::map<std::string, std::string> argumentsOf(const std::string& file)
{
  std::map<std::string, std::string> arguments;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
  {
    const std::string begin = "<arg name=\"";
    const std::size_t at = line.find(begin);
    if (at != std::string::npos && !has(line, " value="))
    {
      const std::size_t name = at + begin.size();
      arguments[line.substr(name, line.find('"', name) - name)] = line;
    }
  }
  return arguments;
}

TEST(LaunchFiles, StartAManagerOfTheirOwnNameOnlyWhenNoneIsNamed)
{
  EXPECT_TRUE(has(runProgram("roslaunch --nodes launch/depth.launch").output, "/light_field_depth_manager"));
  EXPECT_TRUE(has(runProgram("roslaunch --nodes launch/depth.launch name:=front").output, "/front_manager"));
  EXPECT_FALSE(has(runProgram("roslaunch --nodes launch/depth.launch manager:=/mine").output, "_manager"));
}

TEST(LaunchFiles, HaveTheSameArguments)
{
  const std::set<std::string> differs = {"rviz", "rviz_config", "defaults"};
  const std::map<std::string, std::set<std::string>> differs_in = {
      {"array.launch", {"array", "array_file", "fixed_frame"}},  // those of robots
      {"distributed.launch", {"respawn"}},                       // who is lost is used again
      {"rectified_array.launch", {"array"}}};                    // follows rows and columns
  const std::map<std::string, std::set<std::string>> not_in = {
      {"distributed.launch", {"temporal", "manager"}}};  // workers know no last frame
  const auto expected = argumentsOf("launch/depth.launch");
  EXPECT_GT(expected.size(), 20U);
  const auto has_name = [](const auto& sets, const std::string& file, const std::string& name)
  { return sets.count(file) != 0 && sets.at(file).count(name) != 0; };
  for (const std::string file : {"play.launch", "replay.launch", "demo.launch", "array.launch",
                                 "distributed.launch", "rectified_array.launch"})
  {
    auto arguments = argumentsOf("launch/" + file);
    for (const auto& [name, line] : expected)
    {
      if (has_name(not_in, file, name))
      {
        continue;
      }
      ASSERT_EQ(arguments.count(name), 1U) << file << " lacks " << name;
      if (differs.count(name) == 0 && !has_name(differs_in, file, name))
      {
        EXPECT_EQ(arguments[name], line) << file;
      }
    }
  }
}

TEST(LaunchFiles, PassTheirArgumentsOn)
{
  const std::string arguments =
      " sync_tolerance:=0.25 threads:=3 image_transport:=compressed preset:=fast use_camera_info:=false"
      " frame_id:=camera min_confidence:=0.5 queue_size:=9 name:=front";
  for (const char* const launch : {"depth.launch", "play.launch input:=folder", "replay.launch bag:=file.bag",
                                   "demo.launch bag:=file.bag", "array.launch",
                                   "array.launch source:=replay bag:=file.bag", "array.launch source:=depth"})
  {
    const std::string parameters = parametersOf(launch + arguments);
    for (const char* const parameter :
         {"sync_tolerance: 0.25", "threads: 3", "image_transport: compressed", "multiview_preset: fast",
          "use_camera_info: false", "frame_id: camera", "min_confidence: 0.5", "queue_size: 9"})
    {
      EXPECT_TRUE(has(parameters, std::string("/front/") + parameter)) << launch << " " << parameter;
    }
  }
}

TEST(LaunchFiles, PassTheirArgumentsToEveryWorkerAndToTheDistributor)
{
  const std::string parameters = parametersOf(
      "distributed.launch workers:=2 name:=front sync_tolerance:=0.25 image_transport:=compressed "
      "threads:=3 preset:=fast min_confidence:=0.5 frame_id:=camera");
  for (const char* const parameter :
       {"/front/sync_tolerance: 0.25", "/front/image_transport: compressed", "/front/workers: 2"})
  {
    EXPECT_TRUE(has(parameters, parameter)) << parameter;
  }
  for (const char* const worker : {"/worker_0", "/worker_1"})
  {
    for (const char* const parameter :
         {"image_transport: compressed", "threads: 3", "multiview_preset: fast", "min_confidence: 0.5",
          "frame_id: camera", "keep_all: true", "multiview_temporal: false"})
    {
      EXPECT_TRUE(has(parameters, std::string(worker) + "/light_field_depth/" + parameter)) << parameter;
    }
  }
}

/// Runs roslaunch's own loader over a file. @return "NODE MACHINE" of each node
std::string machinesOf(const std::string& launch_file, int expected_exit_code = 0)
{
  const std::string program =
      "import sys, roslaunch.config; config = roslaunch.config.load_config_default([sys.argv[1]], None, "
      "verbose=False); "
      "[print(node.namespace + node.name, node.machine_name) for node in config.nodes]";
  const Outcome outcome =
      runProgram("/usr/bin/python3 -c " + testing::quoted(program) + " " + testing::quoted(launch_file));
  EXPECT_EQ(outcome.exit_code, expected_exit_code) << outcome.errors;
  return outcome.output + outcome.errors;
}

TEST(LaunchFiles, PutEveryWorkerOnAMachineOfItsOwn)
{
  const testing::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& machines)
  {
    return folder
        .write(name,
               "<launch>" + machines + "<include file='" +
                   std::filesystem::absolute("launch/distributed.launch").string() +
                   "'><arg name='workers' value='2'/><arg name='machines' value='m'/></include></launch>")
        .string();
  };
  const std::string first = "<machine name='m0' address='192.0.2.1' user='ros' env-loader='/opt/env.sh'/>";
  const std::string second = "<machine name='m1' address='192.0.2.2' user='ros' env-loader='/opt/env.sh'/>";
  const std::string nodes = machinesOf(write("two.launch", first + second));
  for (const char* const node : {"/worker_0/light_field_depth m0", "/worker_1/light_field_depth m1"})
  {
    EXPECT_NE(nodes.find(node), std::string::npos) << node << "\n" << nodes;
  }
  // The distributor stays where roslaunch runs.
  EXPECT_NE(nodes.find("/light_field_depth None"), std::string::npos) << nodes;
  const std::string error = machinesOf(write("one.launch", first), 1);
  EXPECT_NE(error.find("m1"), std::string::npos) << error;
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
  const std::string quoted = testing::quoted(path);
  const auto expect = [&](const std::string& command)
  { EXPECT_NE(command.find(" " + path + " "), std::string::npos) << command; };
  expect(commandOf("/light_field_player", "play.launch input:=" + quoted));
  expect(commandOf("/rosbag_play", "replay.launch bag:=" + quoted));
  expect(commandOf("/rosbag_play", "demo.launch bag:=" + quoted));
  expect(commandOf("/light_field_player", "array.launch input:=" + quoted));
  expect(commandOf("/rosbag_play", "array.launch source:=replay bag:=" + quoted));
  expect(commandOf("/record", "array.launch record:=" + quoted));
  expect(commandOf("/light_field_depth/rviz", "depth.launch rviz:=true rviz_config:=" + quoted));
}

TEST(LaunchFiles, LeaveToTheArraysFileWhatIsNotGiven)
{
  const testing::TemporaryFolder folder;
  const std::string path = (folder.path() / "mine.yaml").string();
  const std::string file = testing::quoted(path);
  std::ofstream(path) << "array: {rows: 3, columns: 3}\nsync_tolerance: 0.125\nmultiview_temporal: false\n"
                         "keep_all: false\ndense_cloud_voxel_size_m: 0.5\n";
  for (const char* const launch :
       {"depth.launch", "replay.launch bag:=file.bag", "demo.launch bag:=file.bag", "array.launch"})
  {
    const std::string parameters = parametersOf(launch + (" array_file:=" + file));
    EXPECT_TRUE(has(parameters, "/sync_tolerance: 0.125")) << parameters;
    EXPECT_TRUE(has(parameters, "/multiview_temporal: false")) << parameters;
    EXPECT_TRUE(has(parameters, "/keep_all: false")) << parameters;
    EXPECT_TRUE(has(parameters, "/dense_cloud_voxel_size_m: 0.5")) << parameters;
    EXPECT_TRUE(has(parameters, "/array/rows: 3")) << parameters;
    EXPECT_FALSE(has(parameters, "multiview_preset")) << launch << ": the default is the node's";
    EXPECT_TRUE(
        has(parametersOf(launch + (" temporal:=true array_file:=" + file)), "/multiview_temporal: true"));
  }
}

TEST(LaunchFiles, AnArrayIsAStreamAndABagASeriesOfFrames)
{
  const std::string on = "/light_field_depth/multiview_temporal: true";
  EXPECT_TRUE(has(parametersOf("depth.launch"), on));
  const std::string replay = parametersOf("replay.launch bag:=file.bag");
  EXPECT_FALSE(has(replay, on));
  EXPECT_TRUE(has(replay, "/light_field_depth/keep_all: true"));
}

TEST(LaunchFiles, ShowInRVizWhatTheNodeOfAnyNamePublishes)
{
  std::ifstream file("config/rviz/light_field.rviz");
  const std::string config((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_FALSE(has(config, "Topic: /")) << "topics are relative to the node's namespace";
  EXPECT_TRUE(has(commandOf("/front/rviz", "depth.launch rviz:=true name:=front"), "-f front_upright"));
  const std::string known =
      runProgram("roslaunch --nodes launch/depth.launch rviz:=true fixed_frame:=map").output;
  EXPECT_FALSE(has(known, "upright_frame_broadcaster")) << "tf knows it";
}

}  // namespace
}  // namespace light_field_depth
