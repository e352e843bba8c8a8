#include "tools/estimate_frame.h"

#include <optional>
#include <string>

#include "light_field_depth/core/registration.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/evaluation/photometric_error.h"
#include "light_field_depth/evaluation/verdict.h"
#include "light_field_depth/io/cloud_writer.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/intermediate_files.h"
#include "light_field_depth/io/result_folder.h"
#include "tools/estimate_output.h"
#include "tools/estimate_summary.h"
#include "tools/interruption.h"
#include "tools/progress_bar.h"
#include "tools/stopwatch.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

PipelineResult runPipeline(Pipeline& pipeline, const EstimateArguments& arguments, const FrameWork& frame,
                           const fs::path& results, const LightField& light_field,
                           const PipelineOptions& options, CloudWriter* dense_cloud)
{
  ProgressBar progress;
  pipeline.setProgressSink(
      [&](const std::string& stage, double fraction) {
        progress.show(stage,
                      (static_cast<double>(frame.index) + fraction) / static_cast<double>(frame.count));
      });
  if (arguments.save_intermediate)
  {
    const fs::path folder = results / "intermediate";
    pipeline.setIntermediateSink([folder](const std::string& name, const cv::Mat& values)
                                 { writeIntermediate(folder, name, values); });
  }
  ProductRequest request;
  request.depth = true;
  request.organized_cloud = true;
  request.dense_cloud = dense_cloud != nullptr;
  request.dense_cloud_sink = [dense_cloud](const DensePoint* points, std::size_t count)
  { dense_cloud->write(points, count); };
  if (arguments.view_maps)
  {
    request.view_maps = [results, &light_field](const ViewMap& map)
    { writeViewMap(results, light_field.views[map.view_index].grid, map); };
  }
  return pipeline.run(light_field, options, request);
}

void describeResult(const PipelineResult& result, const PhotometricError& error, RunReport& report)
{
  report.views_used = result.estimate.views_used;
  report.disparity_range = result.estimate.range;
  report.stage_times = result.stage_times;
  report.total_ms = result.total_ms;
  report.photometric_error = error.mean;
  report.photometric_error_of_medians = error.mean_of_medians;
}

/// What reading the dataset, the places of the views and the result give to doubt.
/// @param registered the views as they were matched
Verdict judge(const Dataset& dataset, const LightField& registered, const DisparityEstimate& estimate,
              ThreadPool& pool)
{
  Verdict verdict;
  for (const std::string& warning : dataset.warnings)
  {
    verdict.findings.push_back({"input", Finding::Severity::Warning, 1.0, warning});
  }
  for (const Verdict& more :
       {judgeOrder(dataset.light_field, pool, false), judgeResult(registered, estimate, pool)})
  {
    verdict.findings.insert(verdict.findings.end(), more.findings.begin(), more.findings.end());
  }
  return verdict;
}

}  // namespace

bool estimateFrame(const EstimateArguments& arguments, const EstimateInput& input, const FrameWork& frame,
                   Pipeline& pipeline, RunReport report)
{
  const ResultFileOptions output = resultFileOptions(arguments.output_files);
  const Dataset& dataset = input.dataset;
  report.decode_ms = input.decode_ms;
  describeInput(arguments.input, dataset, report);
  if (report.options.disparity_range)
  {
    report.range_source = RangeSource::Given;
  }
  else if (arguments.stated_range && dataset.disparity_range)
  {
    report.options.disparity_range = dataset.disparity_range;
    report.range_source = RangeSource::Dataset;
  }
  const InterruptionGuard guard(&pipeline);
  ResultFolder results(frame.output);
  report.threads = pipeline.threads();
  std::optional<CloudWriter> dense_cloud;
  if (arguments.dense && dataset.light_field.calibration)
  {
    dense_cloud.emplace(results.path() / denseCloudName(output), output.cloud_format, output.axes);
  }
  const PipelineResult result = runPipeline(pipeline, arguments, frame, results.path(), dataset.light_field,
                                            report.options, dense_cloud ? &*dense_cloud : nullptr);
  if (dense_cloud)
  {
    dense_cloud->finish();
  }
  ThreadPool pool(report.threads);
  const LightField registered = registeredViews(dataset.light_field, result.estimate.registration, pool);
  describeResult(result, photometricError(registered, result.estimate.disparity, pool), report);

  const Stopwatch verdict_watch;
  report.verdict = judge(dataset, registered, result.estimate, pool);
  report.stage_times.push_back({"verdict", verdict_watch.milliseconds()});

  guard.check();
  const Stopwatch write_watch;
  writeResultFiles(results.path(), result, dataset.light_field.reference().image, output, report);
  report.write_ms = write_watch.milliseconds();
  report.peak_memory_mb = peakMemoryMb();
  writeFile(results.path() / "report.json", toJson(report));
  guard.check();
  results.commit();
  printSummary(report, frame.output.string());
  guard.check();  // the results are whole, but no further frame is wanted
  return !report.verdict.isDoubtful();
}

}  // namespace light_field_depth
