#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_SCORED_PIXELS_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_SCORED_PIXELS_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Which pixels of a disparity map are scored, and how far off they are.
struct ScoredPixels
{
  std::vector<float> errors;         ///< absolute, px; where the result is not finite, the span of the truth
  std::vector<cv::Point> positions;  ///< in the result, one for each error
  std::size_t known = 0;             ///< pixels with a finite result
};

/// @param result, truth, mask, border_px as evaluate() takes them
/// @throw InputError if sizes do not fit or no pixel is left
ScoredPixels scorePixels(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_SCORED_PIXELS_H
