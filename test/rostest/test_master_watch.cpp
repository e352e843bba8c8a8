#include "ros/master_watch.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "array_fixture.h"
#include "child_program.h"
#include "light_field_depth/io/files.h"
#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
namespace
{
std::string freePort()
{
  const int file = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof(address);
  bind(file, reinterpret_cast<const sockaddr*>(&address), size);
  getsockname(file, reinterpret_cast<sockaddr*>(&address), &size);
  close(file);
  return std::to_string(ntohs(address.sin_port));
}

TEST(MasterWatch, TellsOfAMasterThatStartsAnew)
{
  const TemporaryFolder folder;
  const std::string said = (folder / "said").string();
  const auto says = [&](const std::string& words) { return readFile(said).find(words) != std::string::npos; };
  const std::string port = freePort();
  const std::vector<std::string> start_master = {"/usr/bin/env", "rosmaster", "--core", "-p", port};
  const std::string uri = "http://localhost:" + port;
  Child first(start_master, (folder / "first").string());
  // Without parameters the node is one of a cross of 9 x 9 views, which it waits for.
  const Child node({DEPTH_NODE_PROGRAM}, said, uri);
  ASSERT_TRUE(waitFor([&] { return std::filesystem::exists(said) && says("Depth from 17 views"); }));
  first.end(SIGKILL);
  const Child second(start_master, (folder / "second").string());
  EXPECT_TRUE(waitFor([&] { return says("The ROS master was started anew"); }));
  EXPECT_TRUE(node.isRunning());
}

}  // namespace
}  // namespace light_field_depth::testing
