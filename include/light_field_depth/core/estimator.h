#ifndef LIGHT_FIELD_DEPTH_CORE_ESTIMATOR_H
#define LIGHT_FIELD_DEPTH_CORE_ESTIMATOR_H

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/misfits.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth
{
/// A disparity map in the pixel grid of one view.
struct ViewDisparity
{
  std::size_t view_index = 0;  ///< into LightField::views of the light field that was given to the estimator
  cv::Mat disparity;           ///< CV_32FC1, pixels per grid step; NaN where unknown
  cv::Mat confidence;          ///< CV_32FC1, 0..1; 0 where the disparity is filled
  cv::Mat held{};              ///< CV_32FC1 or empty: instead, where a plane holds it; see DisparityEstimate
};

/// What an estimator finds out about one light field.
struct DisparityEstimate
{
  /// CV_32FC1 in the size of the views: disparity of the reference view in pixels per grid step, positive
  /// nearer than the plane of zero disparity. Dense and finite: where nothing is known the value is filled
  /// from the surroundings and the confidence is 0. A Pipeline makes it NaN where the reference is masked.
  cv::Mat disparity;
  /// CV_32FC1, 0..1; 0 where nothing supports the disparity.
  cv::Mat confidence;
  /// CV_8UC1, 255 where the views themselves tell no disparity above their noise (blank walls), or only one
  /// view sees a point of a pair, so that the disparity is filled from what is certain around it: often
  /// right, never seen. Empty if the method does not tell.
  cv::Mat filled;
  /// The same with those filled pixels that a plane holds, which goes on around them: they count as known in
  /// depth and in the organised cloud, but no view measured them. The dense cloud takes none but those held.
  cv::Mat unmeasured;
  /// CV_8UC1, 255 where the blank part of a flat surface was moved to the plane of what is measured of the
  /// same colour around it: unmeasured, not filled, with a low confidence. The dense cloud takes these pixels
  /// from the view of their own map alone. Empty if the method does not tell.
  cv::Mat held;
  /// The range that was searched: the given one, or the one that was found.
  DisparityRange range;
  /// How many views took part.
  std::size_t views_used = 0;
  /// What was put right before the search (MultiviewOptions::registration): one misfit for each view of the
  /// light field given, none for views that took no part.
  Registration registration;
  /// Maps that were each solved in a view of its own, the reference's first; as many as
  /// EstimateRequest::solved_maps asks for and the views allow.
  std::vector<ViewDisparity> view_disparities;
};

/// What is asked of an estimator besides its options.
struct EstimateRequest
{
  std::optional<DisparityRange> disparity_range;  ///< found from the images when absent
  ViewSelection views = ViewSelection::Auto;      ///< which views take part
  /// How many views to solve a map for, the reference's included, for the dense cloud: those that stand far
  /// apart. 0 leaves DisparityEstimate::view_disparities empty.
  std::size_t solved_maps = 0;
};

/// A method that finds the disparity of a light field. An estimator keeps its buffers from call to call; it
/// is used by one thread at a time. The result does not depend on the number of threads, nor on earlier calls
/// unless an option for video asks for it (MultiviewOptions::temporal).
class Estimator
{
public:
  virtual ~Estimator() = default;

  /// @throw InputError, Cancelled
  virtual DisparityEstimate estimate(const LightField& light_field, const EstimateRequest& request,
                                     RunContext& context) = 0;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_ESTIMATOR_H
