#ifndef LIGHT_FIELD_DEPTH_CORE_VIEW_MAPS_H
#define LIGHT_FIELD_DEPTH_CORE_VIEW_MAPS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/point_cloud.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// What a pixel of a view's map comes from.
enum class ViewPixel : std::uint8_t
{
  Filled = 0,  ///< no map shows it, or they contradict each other: the background beside it, confidence 0
  Solved = 1,  ///< maps of other views than the reference
  Seen = 2     ///< the reference's map, and those that agree with it
};

/// The map of one view.
struct ViewMap
{
  std::size_t view_index = 0;  ///< into LightField::views
  cv::Mat disparity;           ///< CV_32FC1, pixels per step; finite
  cv::Mat confidence;          ///< CV_32FC1, 0..1; 0 where filled
  cv::Mat origin;              ///< CV_8UC1, values of ViewPixel
};

/// Receives the maps one after the other in the order of the views, on the calling thread; they are valid
/// until it returns.
using ViewMapSink = std::function<void(const ViewMap&)>;

/// The map of every view, fused as for denseCloud() from maps that were solved, and filled where there is
/// none.
/// @param maps as an Estimator gives them, the reference's first
void viewMaps(const LightField& light_field, const std::vector<ViewDisparity>& maps,
              const DenseCloudOptions& options, ThreadPool& pool, const ViewMapSink& sink);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_VIEW_MAPS_H
