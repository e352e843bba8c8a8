#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_TOOL_MAIN_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_TOOL_MAIN_H

#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
constexpr int EXIT_INTERRUPTED = 130;  ///< 128 + SIGINT, as shells have it
/// Of a tool that was asked to be strict: the work is done, but the verdict on it is a warning.
constexpr int EXIT_DOUBTFUL = 3;

constexpr const char* NO_MEMORY = "The memory does not suffice; use fewer or smaller views.";

/// Parses the command line and calls body(). Output that cannot be written, to a full disk for one, is an
/// error, too. Whatever goes wrong becomes one sentence on stderr.
/// @return the exit code: 0 or what body() returns, 1 after an error, 130 after an interruption
template <class Body>
int runTool(CLI::App& app, int argc, char** argv, const Body& body)
{
  const auto fail = [&](const std::string& sentence)
  {
    std::cerr << app.get_name() << ": " << sentence << std::endl;
    return 1;
  };
  // A file that may not grow (ulimit -f) is an error of write(), not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  const auto flushed = [&](int exit_code)
  {
    return std::cout.flush() ? exit_code
                             : fail("Standard output cannot be written; check the space on its disk.");
  };
  try
  {
    app.parse(argc, argv);
    if constexpr (std::is_same_v<decltype(body()), int>)
    {
      return flushed(body());
    }
    else
    {
      body();
      return flushed(0);
    }
  }
  catch (const CLI::Success& help)
  {
    return flushed(app.exit(help));
  }
  catch (const CLI::ParseError& error)
  {
    return fail(std::string(error.what()) + " (" + app.get_name() + " --help lists the options)");
  }
  catch (const Cancelled&)
  {
    fail("interrupted.");
    return EXIT_INTERRUPTED;
  }
  catch (const InputError& error)
  {
    return fail(error.what());
  }
  catch (const std::bad_alloc&)
  {
    return fail(NO_MEMORY);
  }
  catch (const cv::Exception& error)
  {
    return fail(error.code == cv::Error::StsNoMem ? NO_MEMORY
                                                  : std::string("An unexpected error: ") + error.what());
  }
  catch (const std::system_error& error)
  {
    return fail(error.code() == std::errc::resource_unavailable_try_again
                    ? "The system gives no further thread; use fewer --threads, or raise its limits of "
                      "processes and memory."
                    : std::string("An unexpected error: ") + error.what());
  }
  catch (const std::exception& error)
  {
    return fail(std::string("An unexpected error: ") + error.what());
  }
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_TOOL_MAIN_H
