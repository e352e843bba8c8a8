#ifndef LIGHT_FIELD_DEPTH_SRC_IO_PLANAR_RIG_H
#define LIGHT_FIELD_DEPTH_SRC_IO_PLANAR_RIG_H

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "io/folder_description.h"

namespace light_field_depth
{
/// A calibrated image that may stand and look anywhere.
struct PosedImage
{
  std::filesystem::path path;
  Intrinsics intrinsics;
  /// From the camera's axes (x to the right, y downwards, z forwards) to the world's.
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d centre;  ///< in the world
};

/// The nearest rotation to a matrix that may be scaled or rounded. @throw InputError if it mirrors or is flat
cv::Matx33d nearestRotation(const cv::Matx33d& matrix, const std::string& name);

/// The image that a frame's name stands for: with or without its ending, beside the description or in a
/// folder for images. Empty if there is none.
std::filesystem::path findFrame(const std::filesystem::path& folder, const std::string& name);

/// The plane of a rig, and its cameras in it.
struct CommonPlane
{
  cv::Matx33d rotation;                ///< from the axes of the plane (z is its normal) to the world's
  Intrinsics common;                   ///< of the camera that all are rectified to
  std::vector<cv::Point2d> positions;  ///< of the cameras in the plane, from its middle
  std::vector<double> off_plane;       ///< distance of each camera from the plane, along the normal
  double width = 0.0;                  ///< of the rig; all lengths in the unit of the poses
};

/// @param source of the poses, for messages
/// @throw InputError that says how far from a plane the cameras stand, or which one looks elsewhere
CommonPlane fitCommonPlane(const std::filesystem::path& source, const std::vector<PosedImage>& images);

/// Rows and columns from the positions: those of a grid, or each camera has a column of its own.
std::vector<GridPosition> numberCameras(const CommonPlane& plane);

/// The images of cameras on a common plane, warped to look along its normal with one focal length.
/// @param unit_m metres of the positions' unit
/// @throw InputError that says how far from a plane the cameras stand, or which one looks elsewhere
FolderDescription describeRig(const std::filesystem::path& folder, const std::vector<PosedImage>& images,
                              double unit_m);

/// An image as the common camera of its rig would see it; black where it does not reach.
cv::Mat warped(const cv::Mat& image, const ViewWarp& warp);

/// The mask (View::mask) of a warped image: masked is also what the image does not reach. Empty if nothing
/// is.
/// @param mask of the image; empty if nothing of it is masked
cv::Mat warpedMask(const cv::Mat& mask, const ViewWarp& warp);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_PLANAR_RIG_H
