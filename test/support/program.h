#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_PROGRAM_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_PROGRAM_H

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
/// What a program left behind.
struct Outcome
{
  int exit_code = -1;  ///< -1 when a signal ended it
  std::string output;
  std::string errors;
};

/// A word of a shell command, whatever characters are in it.
inline std::string quoted(const std::string& text)
{
  std::string result = "'";
  for (const char letter : text)
  {
    result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  }
  return result + "'";
}

/// Runs a shell command without input and waits for its end.
inline Outcome runProgram(const std::string& command)
{
  const TemporaryFolder folder;
  const auto read = [&](const char* name)
  {
    std::ifstream stream(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const int status = std::system((command + " >" + quoted((folder / "out").string()) + " 2>" +
                                  quoted((folder / "err").string()) + " </dev/null")
                                     .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out"), read("err")};
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_PROGRAM_H
