#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_FILLED_REGIONS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_FILLED_REGIONS_H

#include <opencv2/core.hpp>

namespace light_field_depth::multiview
{
struct FilledRegionSettings
{
  /// A cell counts as filled where less than this part of its data is above the noise.
  float below_share = 0.5F;
  /// A region of filled cells of which more of the outline lies at the border of the image is not held by
  /// what is around it. Blank halves of images: 0.61 to 0.66; the bundled scene's blank wall and ball: 0 to
  /// 0.38.
  double max_border = 0.5;
  /// Least part of the known pixels along a region that have to lie on one plane. The wall and the ball: 0.63
  /// to 1; the two surfaces beside a blank space have half of them each.
  double min_planar = 0.6;
  /// Least part of them where the plane also goes on outside: 0.38 to 1. A plane that leans from one surface
  /// to another goes on at neither.
  double min_continued = 0.3;
  /// Pixels that still lie on a plane, in the solver's unit.
  float tolerance_px = 0.1F;
};

/// Where the views themselves tell no disparity above their noise.
/// @param share as for findFilled()
/// @return CV_8UC1 of that size, 255 there
cv::Mat findUnmeasured(const cv::Mat& share, const cv::Size& size, const FilledRegionSettings& settings = {});

/// Where a disparity is filled and nothing tells that it is right: neither the views, nor a plane through
/// most of what is known around the region, as around a blank part of a wall, a table or a ball. Of the
/// bundled scene 4.7 instead of 9.8 % are filled, of blank halves of images 98 % and more (96 % where noise
/// has 5 levels).
/// @param share     CV_32FC1, one for each cell of CELL_PX pixels: NoiseDiscount::share()
/// @param disparity CV_32FC1
/// @return CV_8UC1 in the size of the disparity, 255 where it is filled
cv::Mat findFilled(const cv::Mat& share, const cv::Mat& disparity, const FilledRegionSettings& settings = {});

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_FILLED_REGIONS_H
