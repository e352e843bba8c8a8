#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BLANK_PLANES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BLANK_PLANES_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"

namespace light_field_depth::multiview
{
struct BlankPlaneSettings
{
  /// As in FilledRegionSettings.
  float below_share = 0.5F;
  /// A smaller region is filled well enough by what touches it.
  int min_cells = 48;
  /// How far from a region what is known about its surface may lie.
  int reach_cells = 4;
  /// What is known: pixels of this confidence.
  float min_confidence = 0.5F;
  /// Of the region's colour, in levels of each channel: all others are of other surfaces. Of the bundled
  /// scene's blank wall 47 and 66 % of what lies around are, of its blank ball 7 %.
  int max_difference_levels = 24;
  double min_like = 0.25;
  /// Standard deviation inside of the region, in levels of any channel. What is curved is shaded: the ball
  /// has 11.4, the wall 3.4 and 2.0.
  double max_shading_levels = 8.0;
  /// Least part of what is known and of the region's colour that lies on the plane; of the wall 54 to 90 %.
  double min_on_plane = 0.5;
  /// The rest is nearer: objects, and what the map makes too large of them. What is behind the plane denies
  /// that it is there; of the wall's plane 1 to 2 %, of planes through flags before it 4 to 13 %.
  double max_behind = 0.03;
  /// Pixels that still lie on it, in the solver's unit: about three times the error of the map there.
  float tolerance_px = 0.02F;
  /// How much farther a plane may be off than where it is measured, in variances. The far corner of the wall
  /// has 21.
  double max_leverage = 30.0;
  /// Of what a plane holds: enough for the dense cloud, too little to contradict a map that sees something.
  float confidence = 0.25F;
};

/// Moves blank parts of flat surfaces to the plane of what is measured of these beside them, instead of what
/// the smoothing makes of them: regions where the views tell no disparity, of one unshaded colour, with
/// enough of the same colour around that is known and lies on one plane. Of the bundled scene's blank wall
/// 100 instead of 44 % come within 2 % of their depth.
/// @param share      CV_32FC1, one for each cell of CELL_PX pixels: NoiseDiscount::share()
/// @param image      the reference, whose size the maps have
/// @param disparity  CV_32FC1, in the solver's unit
/// @param confidence CV_32FC1
/// @return CV_8UC1 in the size of the maps, 255 where a plane holds a pixel
cv::Mat holdBlankPlanes(const cv::Mat& share, const PlanarImage& image, const BlankPlaneSettings& settings,
                        cv::Mat& disparity, cv::Mat& confidence);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BLANK_PLANES_H
