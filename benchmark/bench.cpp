// Time and accuracy of the package, each measurement with one command.

#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "ablation.h"
#include "light_fields.h"
#include "report_files.h"

namespace light_field_depth::benchmark
{
namespace
{
int run(int argc, char** argv)
{
  CLI::App app{
      "Time and accuracy of whole light fields beside OpenCV's own methods, unless another "
      "measurement is named."};
  Settings settings;
  bool ablation = false;
  app.add_flag("--ablation", ablation, "each ingredient of multiview off or changed, one at a time");
  app.add_option("--input", settings.inputs, "folders with a light field and its true disparity")->required();
  app.add_option("--runs", settings.runs, "timed runs of each row")
      ->capture_default_str()
      ->check(CLI::Range(1, 999));
  app.add_option("--threads", settings.threads, "threads of every method")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_option("--results", settings.results, "folder for the tables and JSON files")->take_last();
  CLI11_PARSE(app, argc, argv);

  cv::setNumThreads(settings.threads);
  if (ablation)
  {
    ablate(settings);
  }
  else
  {
    compareMethods(settings);
  }
  return 0;
}

}  // namespace
}  // namespace light_field_depth::benchmark

int main(int argc, char** argv)
{
  try
  {
    return light_field_depth::benchmark::run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
