// The program depth_node, as a user starts it: what it says of parameters that it cannot use.

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "support/program.h"

namespace light_field_depth
{
namespace
{
using testing::Outcome;
using testing::quoted;
using testing::runProgram;

std::size_t occurrences(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

/// Each node has a name of its own, since the parameter server keeps what an earlier one was given.
void expectRefusal(const std::string& name, const std::string& arguments, const std::string& sentence)
{
  const Outcome outcome =
      runProgram("timeout 60 " + quoted(DEPTH_NODE_PROGRAM) + " __name:=" + name + " " + arguments);
  EXPECT_EQ(outcome.exit_code, 1) << arguments;
  EXPECT_EQ(occurrences(outcome.errors, "[FATAL]"), 1U) << arguments << "\n" << outcome.errors;
  EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << arguments << "\n" << outcome.errors;
}

TEST(DepthNodeProgram, SaysOnTheConsoleWhyItEnds)
{
  expectRefusal("transport", "_image_transport:=telegraph",
                "'/transport/image_transport' is 'telegraph'; install");
  expectRefusal("no_calibration", "_use_camera_info:=false _focal_length:=500",
                "Without CameraInfo, focal_length");
  expectRefusal("array", "_array:=3", "'array' is not");
  expectRefusal("queue", "_queue_size:=0", "'/queue/queue_size' is 0; give a value from 1");
}

TEST(DepthNodeProgram, SaysUnderRoslaunchWhyItEnds)
{
  const testing::TemporaryFolder folder;
  const auto file =
      folder.write("refused.launch",
                   "<launch>\n"
                   "  <node pkg='light_field_depth' type='depth_node' name='launched' required='true'>\n"
                   "    <rosparam>array: {rows: 3, columns: 3, layout: circle}</rosparam>\n"
                   "  </node>\n"
                   "</launch>\n");
  const Outcome outcome = runProgram("timeout 60 roslaunch --skip-log-check " + quoted(file.string()));
  const std::string said = outcome.output + outcome.errors;
  EXPECT_EQ(occurrences(said, "'array/layout' is 'circle'"), 1U) << said;
  EXPECT_NE(said.find("exit code 1"), std::string::npos) << said;
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
