#ifndef LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_DESCRIPTION_H
#define LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_DESCRIPTION_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
/// Numbers of rows and columns go so far, either way.
constexpr int MAX_NUMBER = 99999;

inline bool canBeCounted(const GridPosition& number)
{
  const auto is_within = [](int value) { return value >= -MAX_NUMBER && value <= MAX_NUMBER; };
  return is_within(number.row) && is_within(number.column);
}

/// The part of an image file that is a view.
struct ViewPart
{
  enum class Kind
  {
    Whole,   ///< the file is the view
    Tile,    ///< the file is a table of views
    Lenslet  ///< the file is a table of lenslets: each has one pixel of every view
  };

  Kind kind = Kind::Whole;
  cv::Size grid;      ///< columns x rows of views in the file
  GridPosition cell;  ///< of this view in the grid
};

/// A pinhole camera with the distortion of OpenCV's model; the centre of the first pixel is (0, 0).
struct Intrinsics
{
  cv::Size size;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
};

/// What turns the image of a camera into that of the common camera of its rig.
struct ViewWarp
{
  Intrinsics common;  ///< without distortion
  Intrinsics source;
  cv::Matx33d rotation;  ///< from the axes of the common camera to those of the source
};

/// A view before it is decoded.
struct ViewFile
{
  std::filesystem::path path;
  GridPosition number;                  ///< as the dataset counts; PlaceClaim::SingleNumber: {0, index}
  std::optional<cv::Point2d> position;  ///< of the camera, in any unit: x to the right, y downwards
  ViewPart part = {};
  std::shared_ptr<const ViewWarp> warp = {};  ///< empty: the image is used as it is
  std::size_t id = 0;                         ///< in the ViewStore
};

/// What a dataset says of its cameras.
struct CameraDescription
{
  double focal_length_px = 0.0;        ///< used if positive, else
  double focal_length_per_side = 0.0;  ///< focal length over the longer side of the image
  std::optional<cv::Point2d>
      principal_point_px;                     ///< of the nominal reference view; the image's centre if absent
  double baseline_m = 0.0;                    ///< between adjacent columns; 0: from the positions
  std::optional<double> focus_distance_m;     ///< absent: parallel cameras, unless the offset says otherwise
  std::optional<double> disparity_offset_px;  ///< Calibration::disparity_offset_px
  int calibrated_width = 0;                   ///< of the images that the pixels above belong to; 0: of these
};

/// What the names and the descriptions in a folder say of its light field.
struct FolderDescription
{
  std::string format;
  PlaceClaim place_claim = PlaceClaim::Stated;
  std::vector<ViewFile> views;
  int first_number = 0;  ///< PlaceClaim::SingleNumber: the least number in the names, at most MAX_NUMBER
  std::optional<cv::Rect> grid;           ///< numbers of all views there could be: x, width are columns
  std::optional<GridPosition> reference;  ///< the view of the truth; the middle of the grid if absent
  std::optional<Flip> flip;               ///< found from the positions, or None, if absent
  std::optional<Order> order;             ///< RowMajor if absent
  std::optional<double> position_unit_m;  ///< metres of one unit of the positions, where that is known
  std::optional<double> step_length;      ///< distance of adjacent columns in the unit of the positions
  double row_step_ratio = 1.0;            ///< distance of adjacent rows over that of adjacent columns
  std::optional<CameraDescription> camera;
  std::optional<DisparityRange> disparity_range;
  std::optional<std::filesystem::path> truth;
  std::vector<std::string> frames;    ///< Dataset::frames
  std::vector<std::string> notes;     ///< Dataset::notes
  std::vector<std::string> warnings;  ///< Dataset::warnings
};

/// Adds what a param.txt beside views that are named by row and column says of their grid (num_x, num_y) and
/// of the steps between columns and rows (base_x, base_y), as the Cambridge synthetic light fields have it.
/// Nothing if there is none, or if it says neither.
void readGridParameters(const std::filesystem::path& folder, FolderDescription& description);

/// Adds what an HCI parameters.cfg says: the grid, cameras, disparity range. @throw InputError
void readHciParameters(const std::filesystem::path& cfg_file, FolderDescription& description);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_DESCRIPTION_H
