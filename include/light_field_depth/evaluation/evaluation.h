#ifndef LIGHT_FIELD_DEPTH_EVALUATION_EVALUATION_H
#define LIGHT_FIELD_DEPTH_EVALUATION_EVALUATION_H

#include <string>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The metrics of the HCI 4D Light Field Benchmark (Honauer et al., ACCV 2016). Errors are absolute
/// differences of disparities in pixels; a result that is not finite counts as bad, and in the mean square
/// error as wrong by the whole range of the truth, or by one pixel where that is less.
struct Evaluation
{
  double mse_100 = 0.0;     ///< mean square error x 100
  double badpix_007 = 0.0;  ///< percentage of pixels with an error above 0.07 px
  double badpix_003 = 0.0;  ///< above 0.03 px
  double badpix_001 = 0.0;  ///< above 0.01 px
  double q25 = 0.0;         ///< 25th percentile of the error x 100
  double coverage = 0.0;    ///< part of the pixels with a finite result, 0..1
};

/// Border that the benchmark leaves out.
constexpr int DEFAULT_EVALUATION_BORDER_PX = 15;

/// @param result CV_32FC1; one that is smaller than the truth is taken as centred in it
/// @param truth  CV_32FC1; pixels where it is not finite are left out
/// @param mask   empty, or CV_8UC1 in the size of the truth: pixels of value 0 are left out
/// @param border_px of the truth is left out on each side
/// @throw InputError if sizes do not fit or no pixel is left
Evaluation evaluate(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask = {},
                    int border_px = DEFAULT_EVALUATION_BORDER_PX);

/// "mse_100 1.234  badpix_007 ...", three decimals each, in one line.
std::string toText(const Evaluation& evaluation);

/// {"mse_100": 1.234, ...}, in one line.
std::string toJson(const Evaluation& evaluation);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_EVALUATION_H
