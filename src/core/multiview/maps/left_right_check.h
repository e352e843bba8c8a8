#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_LEFT_RIGHT_CHECK_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_LEFT_RIGHT_CHECK_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Which pixels of a pair's map the map of its other view confirms.
struct LeftRightSettings
{
  /// Between a pixel and where the other view's disparity brings it back to, in pixels of the reference view.
  float max_distance_px = 1.0F;
  /// Regions of confirmed pixels smaller than this are chance.
  int min_region_px = 60;
  /// Neighbours of one region differ by at most this much, in pixels of displacement between the views.
  float max_step_px = 1.0F;
};

/// Marks the pixels that the other view's map does not confirm: points that the other view does not see, and
/// wrong matches.
/// @param disparity CV_32FC1 of the reference view, finite
/// @param other the view beside the reference; its image is not used
/// @param other_disparity CV_32FC1 of that view, in the same unit; may be smaller by a whole factor
/// @return CV_8UC1, 255 where not confirmed
cv::Mat findUnconfirmed(const cv::Mat& disparity, const View& other, const cv::Mat& other_disparity,
                        const LeftRightSettings& settings, ThreadPool& pool);

/// How pixels without a disparity of their own get one.
struct BackgroundFillSettings
{
  int radius_px = 10;          ///< of the window of the median
  int stride_px = 2;           ///< of its rows and columns that count; a multiple of it leads to the middle
  float colour_scale = 10.0F;  ///< difference of colour, mean of the channels, that lowers a weight by e
  /// Every second row and column take the median of the pixel above or before them if the two colours differ
  /// by no more than this, mean of the channels; negative: every pixel has its own.
  int max_colour_step = -1;
};

/// Gives the marked pixels the disparity of the farther of the two surfaces beside them: what one of two
/// views does not see lies behind. Then a median of their surroundings, weighted by likeness of colour, so
/// that the rows agree with each other and with the edges of the image. Other pixels keep their values; a map
/// without any is left as it is.
/// @param image CV_8UC1 or CV_8UC3, of the reference view
/// @param marked CV_8UC1, not 0 where the disparity is to be filled
/// @param along_columns the views stand above each other
void fillFromBackground(const cv::Mat& image, const cv::Mat& marked, bool along_columns,
                        const BackgroundFillSettings& settings, ThreadPool& pool, cv::Mat& disparity);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_LEFT_RIGHT_CHECK_H
