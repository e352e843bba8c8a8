#ifndef LIGHT_FIELD_DEPTH_IO_REPORT_H
#define LIGHT_FIELD_DEPTH_IO_REPORT_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/core/run_context.h"
#include "light_field_depth/evaluation/verdict.h"
#include "light_field_depth/io/map_files.h"

namespace light_field_depth
{
/// How the disparity range of a run came about.
enum class RangeSource
{
  Given,    ///< by the user
  Dataset,  ///< stated by the dataset
  Found     ///< from the images
};

/// "given", "dataset", "found".
std::string toString(RangeSource source);

/// What is to be known of a run afterwards.
struct RunReport
{
  std::string input;                              ///< folder that was read
  std::string format;                             ///< Dataset::format
  std::string order;                              ///< Dataset::order
  std::string flip;                               ///< Dataset::flip
  std::string layout_source;                      ///< Dataset::layout_source
  std::vector<std::string> notes;                 ///< Dataset::notes
  PipelineOptions options;                        ///< in effect
  std::size_t views_found = 0;                    ///< in the folder
  std::size_t views_used = 0;                     ///< by the method
  GridPosition reference;                         ///< as View::grid counts
  std::string reference_file;                     ///< relative to the folder
  cv::Size size;                                  ///< of each view, pixels
  std::optional<Calibration> calibration;         ///< absent: no metres
  DisparityRange disparity_range;                 ///< that was searched
  RangeSource range_source = RangeSource::Found;  ///< where it came from
  int threads = 0;                                ///< that worked
  std::vector<StageTime> stage_times;             ///< PipelineResult::stage_times
  double decode_ms = 0.0;                         ///< reading and decoding the views
  double total_ms = 0.0;                    ///< the method and the geometry, without decoding and writing
  double write_ms = 0.0;                    ///< writing the results
  double peak_memory_mb = 0.0;              ///< peakMemoryMb()
  std::optional<double> photometric_error;  ///< PhotometricError::mean
  std::optional<double> photometric_error_of_medians;  ///< PhotometricError::mean_of_medians
  std::optional<Png16Scale> disparity_png16;           ///< of disparity_16.png
  Verdict verdict;                                     ///< whether the result can be right
  std::vector<std::string> files;                      ///< written, relative to the output folder
};

/// A JSON object, indented. Times in milliseconds under "timings_ms": every stage by name, besides "decode",
/// "total" and "write".
std::string toJson(const RunReport& report);

/// The largest memory that this process has had resident, in MB of 10^6 bytes; 0 where the system does not
/// tell.
double peakMemoryMb();

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_REPORT_H
