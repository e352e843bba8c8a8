// The pipeline on a dataset folder, without a ROS master.

#include <cstddef>
#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/core/memory_need.h"
#include "tools/estimate_arguments.h"
#include "tools/estimate_frame.h"
#include "tools/estimate_input.h"
#include "tools/estimate_output.h"
#include "tools/tool_main.h"

namespace
{
namespace lfd = light_field_depth;
namespace fs = std::filesystem;

/// The dense cloud and the maps of the views are those of every view, unless some are asked for by name.
bool showsAllViews(const lfd::EstimateArguments& arguments)
{
  return (arguments.dense || arguments.view_maps) && (arguments.views.empty() || arguments.views == "auto");
}

/// Frame after frame; the next one is read while one is solved.
/// @return whether the verdict on none of them has a warning
bool estimateSequence(const lfd::EstimateArguments& arguments, lfd::DatasetOptions options,
                      lfd::RunReport report, lfd::Pipeline& pipeline)
{
  lfd::EstimateInput input =
      lfd::readInput(arguments.input, options, report.options, showsAllViews(arguments));
  const std::vector<std::string> names = lfd::wantedFrames(arguments.frames, input.dataset.frames);
  const auto read = [&](std::size_t index)
  {
    lfd::DatasetOptions of_frame = options;
    of_frame.frame = names[index];
    return lfd::readInput(arguments.input, of_frame, report.options, showsAllViews(arguments));
  };
  // All frames are laid out like the first.
  options.order = input.dataset.order;
  options.flip = input.dataset.flip;
  report.options.multiview.temporal = arguments.temporal.empty() || report.options.multiview.temporal;
  if (names.front() != input.dataset.frames.front())
  {
    input = read(0);
  }
  bool fine = true;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    std::future<lfd::EstimateInput> next;
    if (i + 1 < names.size())
    {
      next = std::async(std::launch::async, read, i + 1);
    }
    fine = lfd::estimateFrame(arguments, input, {fs::path(arguments.output) / names[i], i, names.size()},
                              pipeline, report) &&
           fine;
    if (next.valid())
    {
      input = next.get();
    }
  }
  return fine;
}

/// @return the exit code
int estimate(const lfd::EstimateArguments& arguments)
{
  lfd::RunReport report;
  report.options = lfd::makeOptions(arguments);
  lfd::resultFileOptions(arguments.output_files);
  lfd::Pipeline pipeline(arguments.threads);
  cv::setNumThreads(pipeline.threads());
  lfd::DatasetOptions options = lfd::makeDatasetOptions(arguments);
  options.admit = [&](std::size_t views, const cv::Mat& one)
  {
    lfd::requireViews(views, arguments.limits.views, "Choose fewer --views, or raise --max-views.");
    lfd::ProductRequest request;
    request.dense_cloud = arguments.dense || arguments.view_maps;
    lfd::requireMemory({views, one.size(), one.type()}, report.options, request, arguments.max_memory_mb,
                       "Choose fewer --views, reduce the images, or raise --max-memory.");
  };
  const bool fine =
      arguments.frames.empty()
          ? lfd::estimateFrame(
                arguments, lfd::readInput(arguments.input, options, report.options, showsAllViews(arguments)),
                {arguments.output}, pipeline, report)
          : estimateSequence(arguments, options, report, pipeline);
  return arguments.strict && !fine ? lfd::EXIT_DOUBTFUL : 0;
}

}  // namespace

int main(int argc, char** argv)
{
  lfd::EstimateArguments arguments;
  CLI::App app(
      "Depth from a light field: reads the views in a folder and writes disparity.pfm, confidence.pfm, "
      "disparity.png, report.json and, if the dataset is calibrated, depth.pfm and cloud.ply.",
      "estimate");
  lfd::declare(app, arguments);
  return lfd::runTool(app, argc, argv, [&] { return estimate(arguments); });
}
