// The pipeline on a dataset folder, without a ROS master.

#include <chrono>
#include <csignal>
#include <future>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "light_field_depth/evaluation/photometric_error.h"
#include "light_field_depth/evaluation/verdict.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/intermediate_files.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "light_field_depth/io/report.h"
#include "tools/estimate_output.h"
#include "tools/progress_bar.h"
#include "tools/tool_main.h"

namespace
{
namespace lfd = light_field_depth;
namespace fs = std::filesystem;

constexpr int MAX_THREADS = 1024;

/// The command line as it was typed.
struct Arguments
{
  std::string input;
  std::string output;
  std::string method;
  std::string preset;
  std::string temporal;
  std::string views;
  std::vector<int> reference;
  std::vector<float> disparity_range;
  bool stated_range = false;
  std::string order;
  std::string flip;
  std::string grid;
  std::string tiles;
  std::string frame;
  std::string frames;
  bool dense = false;
  int threads = 0;
  bool save_intermediate = false;
  lfd::OutputArguments output_files;
  std::vector<double> baseline_m;
  std::vector<double> principal_point_px;
  lfd::CameraOptions camera;
  bool strict = false;
  std::string config;
  std::vector<std::string> settings;
};

void declare(CLI::App& app, Arguments& arguments)
{
  app.add_option("--input", arguments.input, "folder with the views of a light field")->required();
  app.add_option("--output", arguments.output, "folder for the results; created if need be")->required();
  app.add_option("--method", arguments.method, "method: " + lfd::methodNames().front() + " by default");
  app.add_option(
      "--preset", arguments.preset,
      "of multiview: quality, balanced, realtime or fast; the same as --set multiview_preset=NAME");
  app.add_option("--temporal", arguments.temporal,
                 "of multiview, for video: true or false; the same as --set multiview_temporal=VALUE");
  app.add_option("--views", arguments.views,
                 "views to use: auto (the method's own choice), row, column, cross, star or all");
  app.add_option("--reference", arguments.reference,
                 "ROW,COL of the reference view, numbered as in the files")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--range,--disparity-range", arguments.disparity_range,
                 "MIN,MAX in pixels between adjacent views; found from the images by default")
      ->delimiter(',')
      ->expected(2);
  app.add_flag("--stated-range", arguments.stated_range,
               "search the range that the dataset's description states")
      ->excludes("--range");
  app.add_option("--order", arguments.order,
                 "auto, row-major or column-major: which of a view's two numbers is the row")
      ->default_val("auto");
  app.add_option("--flip", arguments.flip,
                 "auto, none, rows, columns or both: what is numbered against the convention (rows down, "
                 "columns right)")
      ->default_val("auto");
  app.add_option("--grid", arguments.grid, "ROWSxCOLUMNS of views that are named by one number");
  app.add_option("--tiles", arguments.tiles, "ROWSxCOLUMNS of the views in one image");
  app.add_option("--frame", arguments.frame,
                 "number or folder of the frame of a sequence; the first by default");
  app.add_option(
         "--frames", arguments.frames,
         "FIRST:LAST frames of a sequence, or all; each has its results in a folder of its name, and helps "
         "the next one")
      ->excludes("--frame");
  app.add_flag("--dense", arguments.dense, "also write the extra dense cloud of all views");
  app.add_option("--threads", arguments.threads, "threads to work with; 0 takes one per processor")
      ->check(CLI::Range(0, MAX_THREADS));
  app.add_flag("--save-intermediate", arguments.save_intermediate,
               "also write the results of the single stages to OUTPUT/intermediate");
  lfd::declareOutput(app, arguments.output_files);
  app.add_option("--focal-length", arguments.camera.focal_length_px, "pixels, for depth in metres")
      ->check(CLI::PositiveNumber);
  app.add_option("--baseline", arguments.baseline_m,
                 "metres between adjacent views, or X,Y: between columns and between rows")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(CLI::PositiveNumber);
  app.add_option("--principal-point", arguments.principal_point_px,
                 "X,Y in pixels; the image's middle by default")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--focus-distance", arguments.camera.focus_distance_m,
                 "metres to the plane of zero disparity; parallel cameras by default")
      ->check(CLI::PositiveNumber);
  app.add_flag(
      "--strict", arguments.strict,
      "exit with 3 if the verdict on the result has a warning; the results are written all the same");
  app.add_option("--config", arguments.config, "YAML file of settings, as under 'options' in report.json");
  app.add_option("--set", arguments.settings, "NAME=VALUE of one setting; may be repeated");
}

/// Later ones win: the defaults, the file, --set, the options with a name of their own.
lfd::PipelineOptions makeOptions(const Arguments& arguments)
{
  lfd::PipelineOptions options;
  if (!arguments.config.empty())
  {
    lfd::readOptionsFile(arguments.config, options);
  }
  for (const std::string& setting : arguments.settings)
  {
    lfd::setOption(options, setting);
  }
  if (!arguments.method.empty())
  {
    options.method = lfd::methodFromString(arguments.method);
  }
  const auto set_of_multiview = [&](const char* name, const std::string& value)
  {
    if (value.empty())
    {
      return;
    }
    if (options.method != lfd::Method::Multiview)
    {
      throw lfd::InputError("--" + std::string(name) +
                            " belongs to the method multiview, but the method is " +
                            toString(options.method) + "; leave one of them out.");
    }
    lfd::setOption(options, "multiview_" + std::string(name), value);
  };
  set_of_multiview("preset", arguments.preset);
  set_of_multiview("temporal", arguments.temporal);
  if (!arguments.views.empty())
  {
    options.views = lfd::viewSelectionFromString(arguments.views);
  }
  if (!arguments.disparity_range.empty())
  {
    options.disparity_range = lfd::DisparityRange{arguments.disparity_range[0], arguments.disparity_range[1]};
  }
  const std::vector<std::string> problems = lfd::validate(options);
  if (!problems.empty())
  {
    throw lfd::InputError(problems.front());
  }
  return options;
}

lfd::DatasetOptions makeDatasetOptions(const Arguments& arguments)
{
  lfd::DatasetOptions options;
  options.threads = arguments.threads;
  if (!arguments.reference.empty())
  {
    options.reference = lfd::GridPosition{arguments.reference[0], arguments.reference[1]};
  }
  options.camera = arguments.camera;
  if (!arguments.baseline_m.empty())
  {
    options.camera.baseline_m = cv::Point2d(arguments.baseline_m.front(), arguments.baseline_m.back());
  }
  if (!arguments.principal_point_px.empty())
  {
    options.camera.principal_point_px =
        cv::Point2d(arguments.principal_point_px[0], arguments.principal_point_px[1]);
  }
  options.order = lfd::orderOption(arguments.order);
  options.flip = lfd::flipOption(arguments.flip);
  if (!arguments.grid.empty())
  {
    options.grid = lfd::gridFromString("--grid", arguments.grid);
  }
  if (!arguments.tiles.empty())
  {
    options.tiles = lfd::gridFromString("--tiles", arguments.tiles);
  }
  if (!arguments.frame.empty())
  {
    options.frame = arguments.frame;
  }
  return options;
}

class Stopwatch
{
public:
  double milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

lfd::Pipeline* running_pipeline = nullptr;

/// Makes an interruption end the computation in order, so that no file is left half-written.
class InterruptionGuard
{
public:
  explicit InterruptionGuard(lfd::Pipeline& pipeline)
  {
    running_pipeline = &pipeline;
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
  }
  ~InterruptionGuard()
  {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    running_pipeline = nullptr;
  }
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

private:
  static void stop(int /*signal*/) { running_pipeline->cancel(); }
};

/// Where the results of one frame go, and which part of the whole work it is.
struct Frame
{
  fs::path output;
  std::size_t index = 0;
  std::size_t count = 1;
};

lfd::PipelineResult runPipeline(lfd::Pipeline& pipeline, const Arguments& arguments, const Frame& frame,
                                const lfd::LightField& light_field, const lfd::PipelineOptions& options)
{
  const InterruptionGuard guard(pipeline);
  lfd::ProgressBar progress;
  pipeline.setProgressSink(
      [&](const std::string& stage, double fraction) {
        progress.show(stage,
                      (static_cast<double>(frame.index) + fraction) / static_cast<double>(frame.count));
      });
  if (arguments.save_intermediate)
  {
    const fs::path folder = frame.output / "intermediate";
    pipeline.setIntermediateSink([folder](const std::string& name, const cv::Mat& values)
                                 { lfd::writeIntermediate(folder, name, values); });
  }
  lfd::ProductRequest request;
  request.depth = true;
  request.organized_cloud = true;
  request.dense_cloud = arguments.dense;
  return pipeline.run(light_field, options, request);
}

void describeInput(const std::string& input, const lfd::Dataset& dataset, lfd::RunReport& report)
{
  const lfd::LightField& light_field = dataset.light_field;
  report.input = input;
  report.format = dataset.format;
  report.order = toString(dataset.order);
  report.flip = toString(dataset.flip);
  report.layout_source = toString(dataset.layout_source);
  report.notes = dataset.notes;
  report.views_found = dataset.views_found;
  report.reference = light_field.reference().grid;
  report.reference_file = dataset.files[light_field.reference_index].filename().string();
  report.size = light_field.size();
  report.calibration = light_field.calibration;
}

void describeResult(const lfd::PipelineResult& result, const lfd::PhotometricError& error,
                    lfd::RunReport& report)
{
  report.views_used = result.estimate.views_used;
  report.disparity_range = result.estimate.range;
  report.stage_times = result.stage_times;
  report.total_ms = result.total_ms;
  report.photometric_error = error.mean;
  report.photometric_error_of_medians = error.mean_of_medians;
}

std::string sentenceOfInput(const lfd::RunReport& report)
{
  std::ostringstream text;
  text << report.views_found << " views (" << report.format << ") of " << report.size.width << " x "
       << report.size.height << " pixels, " << report.views_used << " used; reference "
       << report.reference_file << "; method " << toString(report.options.method) << ".";
  return text.str();
}

std::string sentenceOfLayout(const lfd::RunReport& report)
{
  return "Layout of the views: " + report.order + ", flip " + report.flip + " (from the " +
         report.layout_source + ").";
}

void printSummary(const lfd::RunReport& report, const std::string& output)
{
  std::cout << std::fixed << std::setprecision(2) << sentenceOfInput(report) << "\n"
            << sentenceOfLayout(report) << "\n"
            << "Disparity range " << report.disparity_range.min << " .. " << report.disparity_range.max
            << " px (" << toString(report.range_source) << "), photometric error "
            << *report.photometric_error << " levels.\n"
            << std::setprecision(0) << "Decoding " << report.decode_ms << " ms, method " << report.total_ms
            << " ms on " << report.threads << " thread(s), writing " << report.write_ms << " ms, peak memory "
            << report.peak_memory_mb << " MB.\n";
  if (!report.calibration)
  {
    std::cout << "The dataset has no calibration, so there is no depth and no cloud.\n";
  }
  std::cout << "Wrote to " << output << ":";
  for (const std::string& file : report.files)
  {
    std::cout << " " << file;
  }
  std::cout << std::endl;
}

/// What reading the dataset, the places of the views and the result give to doubt.
lfd::Verdict judge(const lfd::Dataset& dataset, const lfd::DisparityEstimate& estimate, lfd::ThreadPool& pool)
{
  lfd::Verdict verdict;
  for (const std::string& warning : dataset.warnings)
  {
    verdict.findings.push_back({"input", lfd::Finding::Severity::Warning, 1.0, warning});
  }
  for (const lfd::Verdict& more : {lfd::judgeOrder(dataset.light_field, pool, false),
                                   lfd::judgeResult(dataset.light_field, estimate, pool)})
  {
    verdict.findings.insert(verdict.findings.end(), more.findings.begin(), more.findings.end());
  }
  return verdict;
}

/// A light field and how long it took to read it.
struct Input
{
  lfd::Dataset dataset;
  double decode_ms = 0.0;
};

Input readInput(const std::string& folder, lfd::DatasetOptions options, const lfd::PipelineOptions& settings)
{
  const Stopwatch watch;
  options.selection = [&settings](const lfd::LightField& without_images)
  { return lfd::viewsToRead(without_images, settings); };
  Input input;
  input.dataset = lfd::readDataset(folder, options);
  input.decode_ms = watch.milliseconds();
  return input;
}

/// Solves one light field and writes its results.
/// @return whether the verdict has no warning
bool estimateFrame(const Arguments& arguments, const Input& input, const Frame& frame,
                   lfd::Pipeline& pipeline, lfd::RunReport report)
{
  const lfd::OutputOptions output = lfd::outputOptions(arguments.output_files);
  const lfd::Dataset& dataset = input.dataset;
  report.decode_ms = input.decode_ms;
  describeInput(arguments.input, dataset, report);
  if (report.options.disparity_range)
  {
    report.range_source = lfd::RangeSource::Given;
  }
  else if (arguments.stated_range && dataset.disparity_range)
  {
    report.options.disparity_range = dataset.disparity_range;
    report.range_source = lfd::RangeSource::Dataset;
  }
  lfd::makeFolder(frame.output);
  report.threads = pipeline.threads();
  const lfd::PipelineResult result =
      runPipeline(pipeline, arguments, frame, dataset.light_field, report.options);
  lfd::ThreadPool pool(report.threads);
  describeResult(result, lfd::photometricError(dataset.light_field, result.estimate.disparity, pool), report);

  const Stopwatch verdict_watch;
  report.verdict = judge(dataset, result.estimate, pool);
  report.stage_times.push_back({"verdict", verdict_watch.milliseconds()});

  const Stopwatch write_watch;
  lfd::writeResults(frame.output, result, dataset.light_field.reference().image, output, report);
  report.write_ms = write_watch.milliseconds();
  report.peak_memory_mb = lfd::peakMemoryMb();
  lfd::writeFile(frame.output / "report.json", toJson(report));
  printSummary(report, frame.output.string());
  for (const std::string& note : report.notes)
  {
    std::cout << "Note: " << note << "\n";
  }
  for (const std::string& warning : report.verdict.warnings())
  {
    std::cerr << "Warning: " << warning << "\n";
  }
  return !report.verdict.isDoubtful();
}

/// The names of the frames from --frames among all of a sequence.
std::vector<std::string> wantedFrames(const std::string& text, const std::vector<std::string>& names)
{
  if (names.empty())
  {
    throw lfd::InputError("--frames is given, but the input is a single light field.");
  }
  if (text == "all")
  {
    return names;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
  {
    throw lfd::InputError("--frames is '" + text + "'; give FIRST:LAST, as in 0:99, or all.");
  }
  const std::size_t first = lfd::frameIndex(names, text.substr(0, colon));
  const std::size_t last = lfd::frameIndex(names, text.substr(colon + 1));
  if (first > last)
  {
    throw lfd::InputError("--frames is '" + text + "', but '" + names[first] + "' comes after '" +
                          names[last] + "'; give the first frame first.");
  }
  return {names.begin() + static_cast<std::ptrdiff_t>(first),
          names.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

/// Frame after frame; the next one is read while one is solved.
/// @return whether the verdict on none of them has a warning
bool estimateSequence(const Arguments& arguments, lfd::DatasetOptions options, lfd::RunReport report,
                      lfd::Pipeline& pipeline)
{
  Input input = readInput(arguments.input, options, report.options);
  const std::vector<std::string> names = wantedFrames(arguments.frames, input.dataset.frames);
  const auto read = [&](std::size_t index)
  {
    lfd::DatasetOptions of_frame = options;
    of_frame.frame = names[index];
    return readInput(arguments.input, of_frame, report.options);
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
    std::future<Input> next;
    if (i + 1 < names.size())
    {
      next = std::async(std::launch::async, read, i + 1);
    }
    fine = estimateFrame(arguments, input, {fs::path(arguments.output) / names[i], i, names.size()}, pipeline,
                         report) &&
           fine;
    if (next.valid())
    {
      input = next.get();
    }
  }
  return fine;
}

/// @return the exit code
int estimate(const Arguments& arguments)
{
  lfd::RunReport report;
  report.options = makeOptions(arguments);
  lfd::outputOptions(arguments.output_files);
  lfd::Pipeline pipeline(arguments.threads);
  cv::setNumThreads(pipeline.threads());
  const lfd::DatasetOptions options = makeDatasetOptions(arguments);
  const bool fine = arguments.frames.empty()
                        ? estimateFrame(arguments, readInput(arguments.input, options, report.options),
                                        {arguments.output}, pipeline, report)
                        : estimateSequence(arguments, options, report, pipeline);
  return arguments.strict && !fine ? lfd::EXIT_DOUBTFUL : 0;
}

}  // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app(
      "Depth from a light field: reads the views in a folder and writes disparity.pfm, confidence.pfm, "
      "disparity.png, report.json and, if the dataset is calibrated, depth.pfm and cloud.ply.",
      "estimate");
  declare(app, arguments);
  return lfd::runTool(app, argc, argv, [&] { return estimate(arguments); });
}
