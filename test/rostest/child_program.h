#ifndef LIGHT_FIELD_DEPTH_TEST_ROSTEST_CHILD_PROGRAM_H
#define LIGHT_FIELD_DEPTH_TEST_ROSTEST_CHILD_PROGRAM_H

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

namespace light_field_depth::testing
{
/// A program that runs beside the test, and ends with it.
class Child
{
public:
  /// @param output file for what it says; empty: where the test's own goes
  /// @param master  of ROS; empty: the test's
  explicit Child(const std::vector<std::string>& words, const std::string& output = "",
                 const std::string& master = "")
  {
    std::vector<char*> arguments;
    for (const std::string& word : words)
    {
      arguments.push_back(const_cast<char*>(word.c_str()));
    }
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0)
    {
      if (!output.empty())
      {
        const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
      }
      if (!master.empty())
      {
        setenv("ROS_MASTER_URI", master.c_str(), 1);
        setenv("ROSCONSOLE_STDOUT_LINE_BUFFERED", "1", 1);
      }
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
  }
  ~Child()
  {
    if (process_ > 0)
    {
      end(SIGKILL);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t process() const { return process_; }
  bool isRunning() const { return kill(process_, 0) == 0 && waitpid(process_, nullptr, WNOHANG) == 0; }

  /// Sends a signal and waits for the end. @return its status
  int end(int signal)
  {
    int status = 0;
    kill(process_, signal);
    waitpid(process_, &status, 0);
    process_ = -1;
    return status;
  }

private:
  pid_t process_ = -1;
};

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_ROSTEST_CHILD_PROGRAM_H
