// Time and accuracy of the package, each measurement with one command.

#include <algorithm>
#include <array>
#include <string>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "ablation.h"
#include "captures.h"
#include "conditions.h"
#include "kernel_benchmark.h"
#include "light_fields.h"
#include "memory.h"
#include "pairs.h"
#include "profile.h"
#include "report_files.h"
#include "scaling.h"
#include "tools/tool_main.h"
#include "video.h"
#include "view_order.h"

namespace light_field_depth::benchmark
{
namespace
{
struct Measurement
{
  const char* flag;
  const char* description;
  void (*run)(const Settings&);
};

/// Taken when none is named.
constexpr const char* DEFAULT_FLAG = "--light-fields";

/// The memory comes first: what others leave behind in the process would count.
constexpr std::array<Measurement, 12> MEASUREMENTS = {{
    {"--memory", "the most memory that the process holds", measureMemory},
    {"--light-fields", "time and accuracy of whole light fields beside OpenCV's methods (the default)",
     compareMethods},
    {"--presets", "time and accuracy of the presets alone", measurePresets},
    {"--ablation", "each ingredient of multiview off or changed, one at a time", ablate},
    {"--conditions",
     "the default method with noise, as cameras see, with fewer views, in grey, with uneven exposure",
     measureConditions},
    {"--captures", "light fields of real cameras, without truth", measureCaptures},
    {"--order", "whether the layout of the views is found from the images", measureViewOrder},
    {"--pairs", "pairs of views beside OpenCV's semi-global block matching", comparePairs},
    {"--kernels", "the inner loops with and without vectors, and the machine's limits", benchmarkKernels},
    {"--scaling", "how the time grows with pixels, views, labels and threads", measureGrowth},
    {"--profile", "where the time of a frame goes, and what the machine could do in it", profileFrame},
    {"--video", "a moving light field, frame by frame and with the last frame's help", measureVideo},
}};

void declare(CLI::App& app, Settings& settings)
{
  for (const Measurement& measurement : MEASUREMENTS)
  {
    app.add_flag(measurement.flag, measurement.description);
  }
  app.add_flag("--all", "all measurements, one after the other");
  app.add_option("--input", settings.inputs, "folders with a light field and its true disparity")->required();
  app.add_option(
      "--capture", settings.captures,
      "folders with light fields for --captures, each as FOLDER or FOLDER,FLIP (none, rows, columns, "
      "both)");
  app.add_option(
      "--pair", settings.pairs,
      "more pairs for --pairs, each as LEFT,RIGHT,TRUTH[,LEVELS]: images and a PFM, or an image of the "
      "disparity with so many levels a pixel");
  app.add_option("--runs", settings.runs, "timed runs of each row")
      ->capture_default_str()
      ->check(CLI::Range(1, 999));
  app.add_option("--threads", settings.threads, "threads of every method")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_option("--results", settings.results, "folder for the tables and JSON files")->take_last();
}

void runMeasurements(const CLI::App& app, const Settings& settings)
{
  cv::setNumThreads(settings.threads);
  const bool all = app.count("--all") > 0;
  const auto is_named = [&](const Measurement& measurement) { return app.count(measurement.flag) > 0; };
  const bool none = !all && std::none_of(MEASUREMENTS.begin(), MEASUREMENTS.end(), is_named);
  for (const Measurement& measurement : MEASUREMENTS)
  {
    if (all || is_named(measurement) || (none && std::string(measurement.flag) == DEFAULT_FLAG))
    {
      measurement.run(settings);
    }
  }
}

}  // namespace
}  // namespace light_field_depth::benchmark

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  CLI::App app("Time and accuracy of this package; prints tables in Markdown.", "bench");
  benchmark::Settings settings;
  benchmark::declare(app, settings);
  return runTool(app, argc, argv, [&] { benchmark::runMeasurements(app, settings); });
}
