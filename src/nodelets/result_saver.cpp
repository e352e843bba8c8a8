#include "light_field_depth/nodelets/result_saver.h"

#include <filesystem>

#include "light_field_depth/io/files.h"
#include "light_field_depth/io/report.h"
#include "light_field_depth/io/result_files.h"
#include "light_field_depth/io/result_folder.h"

namespace light_field_depth
{
void saveResult(const ResultToSave& saved)
{
  makeFolder(std::filesystem::path(saved.folder).parent_path());
  ResultFolder folder(saved.folder);
  RunReport report;
  report.input = saved.source;
  report.format = "ROS topics";
  report.flip = "none";
  report.options = saved.options;
  report.views_found = saved.views_found;
  report.views_used = saved.result.estimate.views_used;
  report.reference = saved.reference;
  report.reference_file = saved.source;
  report.size = saved.result.estimate.disparity.size();
  report.calibration = saved.calibration;
  report.disparity_range = saved.result.estimate.range;
  report.range_source = saved.options.disparity_range ? RangeSource::Given : RangeSource::Found;
  report.threads = saved.threads;
  report.stage_times = saved.result.stage_times;
  report.total_ms = saved.result.total_ms;
  report.peak_memory_mb = peakMemoryMb();
  writeResultFiles(folder.path(), saved.result, cv::Mat(), ResultFileOptions(), report);
  writeFile(folder.path() / "report.json", toJson(report));
  folder.commit();
}

}  // namespace light_field_depth
