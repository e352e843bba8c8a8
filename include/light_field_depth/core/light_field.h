#ifndef LIGHT_FIELD_DEPTH_CORE_LIGHT_FIELD_H
#define LIGHT_FIELD_DEPTH_CORE_LIGHT_FIELD_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Where a view stands in the grid of its light field. Rows grow downwards, columns to the right.
struct GridPosition
{
  int row = 0;     ///< downwards
  int column = 0;  ///< to the right
};

inline bool operator==(const GridPosition& a, const GridPosition& b)
{
  return a.row == b.row && a.column == b.column;
}

inline bool operator<(const GridPosition& a, const GridPosition& b)
{
  return a.row != b.row ? a.row < b.row : a.column < b.column;
}

/// "(row, column)", for messages.
std::string toString(const GridPosition& position);

/// One rectified sub-aperture view.
///
/// A scene point of disparity d that the reference view sees at pixel p is seen by this view at
///   p - d * steps + offset_px
/// (component by component). On an ideal grid, steps = (column - column0, row - row0) and offset_px = 0.
struct View
{
  GridPosition grid;  ///< its place

  /// CV_8UC1, CV_8UC3 (BGR), CV_16UC1 or CV_16UC3; the same size and type in all views of a light field.
  cv::Mat image;

  /// CV_8UC1 in the size of the image: 0 where the image shows nothing of the scene (beyond what a
  /// rectification could fill, outside of a lens), anything else where it does. Empty: it does everywhere.
  cv::Mat mask;

  /// Position of the camera in units of one grid step, x to the right, y downwards. makeLightField() makes
  /// it relative to the reference view. Calibrated arrays may have positions off the grid, and a y unit
  /// that differs from the row number where rows and columns have different baselines.
  cv::Point2d steps;

  /// Displacement in pixels that no disparity explains (an irregular principal point).
  cv::Point2d offset_px;
};

/// A view on an ideal grid: steps = (column, row).
View gridView(int row, int column, cv::Mat image);

/// What turns disparities into metres. The pinhole model of the reference view.
struct Calibration
{
  /// Focal length of the rectified views, in pixels; > 0.
  double focal_length_px = 0.0;

  /// Principal point of the reference view in pixels; the centre of the first pixel is (0, 0).
  cv::Point2d principal_point_px;

  /// Metres a camera moves for one unit of View::steps; > 0.
  double baseline_m = 0.0;

  /// d_inf in Z = f * baseline / (d + d_inf): minus the disparity of a point at infinity. It is the change of
  /// the principal point from one view to the next, 0 for parallel cameras, and f * baseline / Z_focus for a
  /// light field focused (sheared) on a plane at depth Z_focus.
  double disparity_offset_px = 0.0;
};

/// Disparities in pixels per grid step, min < max.
struct DisparityRange
{
  float min = 0.0F;  ///< of the farthest points
  float max = 0.0F;  ///< of the nearest points
};

/// A set of rectified views on a common plane. Any subset of a grid is legal: a row, a column, a cross, a
/// sparse grid. Images are shared, not copied, when a LightField is copied.
struct LightField
{
  std::vector<View> views;                 ///< in row-major order of their grid positions, no position twice
  std::size_t reference_index = 0;         ///< the view that the disparity map belongs to
  std::optional<Calibration> calibration;  ///< absent: there are no metres

  const View& reference() const { return views[reference_index]; }  ///< the view at reference_index
  cv::Size size() const { return views.empty() ? cv::Size() : reference().image.size(); }  ///< of each view
};

/// Checks the views, sorts them row-major, chooses the reference (the view nearest the middle of the grid
/// that the views span, unless one is named) and makes View::steps relative to it.
/// @throw InputError if there are fewer than two views, a position occurs twice, an image is empty, of a type
///   not listed at View::image or smaller than 16 x 16, sizes or types differ, a mask is not as View::mask
///   says or leaves nothing of the reference, the named reference is not among the views, all views stand at
///   one place, or the calibration is not positive and finite.
LightField makeLightField(std::vector<View> views, std::optional<GridPosition> reference = std::nullopt,
                          std::optional<Calibration> calibration = std::nullopt);

/// Which views of a light field to use.
enum class ViewSelection
{
  Auto,    ///< the method's own choice
  Row,     ///< the row of the reference view
  Column,  ///< the column of the reference view
  Cross,   ///< both
  Star,    ///< the cross and both diagonals through the reference view
  All
};

/// "auto", "row", "column", "cross", "star", "all".
std::string toString(ViewSelection selection);
/// The inverse of toString(). @throw InputError that lists the names.
ViewSelection viewSelectionFromString(const std::string& name);

/// The light field reduced to the selected views. Auto keeps every view.
/// @throw InputError if fewer than two views remain.
LightField selectViews(const LightField& light_field, ViewSelection selection);

/// The same light field with 8-bit images. Images of 16 bits are scaled by one rule that is common to all
/// views: the smallest power of two that holds all but the brightest thousandth of the values becomes 255,
/// and 0 stays 0; where the values fill less than a quarter of that, as those of a thermal camera do, a
/// window about them is spread instead. Images of 8 bits are shared.
LightField toEightBit(const LightField& light_field);

/// The brightness of a grey or BGR image. @return the image itself, sharing its pixels, if it is grey
cv::Mat toGrey(const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_LIGHT_FIELD_H
