#ifndef LIGHT_FIELD_DEPTH_CORE_POINT_CLOUD_H
#define LIGHT_FIELD_DEPTH_CORE_POINT_CLOUD_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// A coloured point in the optical frame of the reference view: x right, y down, z forward, metres.
/// Laid out like a PointCloud2 with fields x y z rgb and a point_step of 16 bytes.
struct ColoredPoint
{
  float x;              ///< metres
  float y;              ///< metres
  float z;              ///< metres
  std::uint8_t b;       ///< blue
  std::uint8_t g;       ///< green
  std::uint8_t r;       ///< red
  std::uint8_t unused;  ///< fills the 16 bytes
};
static_assert(sizeof(ColoredPoint) == 16, "the clouds are written straight into message buffers");

/// Room for the points of a cloud in memory of the caller's, such as the buffer of a message. Called once, on
/// the calling thread, when the number of points is known; what it throws comes out of the function that
/// makes the cloud. Where it returns nullptr, the cloud is left out.
using PointAllocator = std::function<ColoredPoint*(std::size_t count)>;

/// The depth of the reference view as an organised cloud (paper, 3.3.1).
/// @param disparity  CV_32FC1, the reference view's
/// @param confidence CV_32FC1, or empty
/// @param points     room for rows * cols points, row-major; x y z are NaN where nothing is known or the
///                   confidence is below min_confidence
/// @pre light_field.calibration is set
void unprojectReference(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                        float min_confidence, ThreadPool& pool, ColoredPoint* points);

/// Which points the dense cloud has.
struct DenseCloudOptions
{
  /// Points of lower confidence are left out. Raise it when the cloud has stray points.
  float min_confidence = 0.1F;
  /// Edge of the cubes inside which points are merged into their mean, in metres; 0 keeps every point. Raise
  /// it when the cloud is too large to transport or to show.
  float voxel_size_m = 0.0F;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const DenseCloudOptions& options);

/// The extra dense cloud (paper, 3.3.2): every pixel of every view's map, unprojected with the centre and the
/// colour of its own camera. No NaN in it; the order of the points depends on nothing but the input.
/// @param room asked for as many points as there are
/// @pre light_field.calibration is set
/// @pre validate(options) is empty
void denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                const DenseCloudOptions& options, ThreadPool& pool, const PointAllocator& room);

/// The same, into a vector.
std::vector<ColoredPoint> denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                     const DenseCloudOptions& options, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_POINT_CLOUD_H
