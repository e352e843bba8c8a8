#ifndef LIGHT_FIELD_DEPTH_EVALUATION_CLOUD_SCORE_H
#define LIGHT_FIELD_DEPTH_EVALUATION_CLOUD_SCORE_H

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// What one view truly sees.
struct ViewTruth
{
  cv::Point2d steps;      ///< View::steps, relative to the reference view
  cv::Point2d offset_px;  ///< View::offset_px
  cv::Mat disparity;      ///< CV_32FC1 in the pixel grid of the view, pixels per step; not finite: unknown
};

/// The true surfaces of a scene, as far as some views see them.
struct CloudTruth
{
  Calibration calibration;       ///< of the reference view
  std::vector<ViewTruth> views;  ///< the reference view first
};

/// A cloud against true surfaces, in the way of multi-view stereo benchmarks (Knapitsch et al., Tanks and
/// Temples, 2017): accuracy is the share of the points that lie near a true surface, completeness the share
/// of the true surface that has a point near it. Distances are those of (x / z, y / z, ln z), in which the
/// error of a camera is the same near and far: 1 % is one hundredth of the depth along the ray, and as far
/// across it.
struct CloudScore
{
  std::size_t points = 0;            ///< scored
  std::size_t surface_elements = 0;  ///< of 1 pixel x 1 pixel x 1 % of depth that hold a point
  double accuracy_025 = 0.0;         ///< percentage of the points within 0.25 % of a true surface
  double accuracy_1 = 0.0;           ///< within 1 %
  double off_2 = 0.0;                ///< percentage that is more than 2 % from every true surface
  /// Percentage of the points that are more than 2 % off and hang between foreground and background: their
  /// depth is one between those that the reference view truly has within three pixels of them.
  double flying = 0.0;
  double completeness_025 =
      0.0;                      ///< percentage of what the reference view sees that has a point within 0.25 %
  double completeness_1 = 0.0;  ///< within 1 %
  double completeness_2 = 0.0;  ///< within 2 %
  double hidden_1 = 0.0;        ///< the same of what other views see and the reference does not; NaN if none
  double hidden_2 = 0.0;        ///< within 2 %
};

/// @param points metres, in the optical frame of the reference view, z forward
/// @throw InputError if there are no points, a point is not in front of the camera, or no truth is finite
CloudScore scoreCloud(const std::vector<cv::Point3f>& points, const CloudTruth& truth, ThreadPool& pool);

/// "points 1234  surface_elements ...", in one line.
std::string toText(const CloudScore& score);

/// {"points": 1234, ...}, in one line; what is not a number is null.
std::string toJson(const CloudScore& score);

/// CV_8UC1, 255 where a view truly sees what the reference view (the first) does not: nearer surfaces hide
/// it, by more than 2 % of depth, or it lies outside of the reference's image.
cv::Mat hiddenFromReference(const CloudTruth& truth, std::size_t view);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_CLOUD_SCORE_H
