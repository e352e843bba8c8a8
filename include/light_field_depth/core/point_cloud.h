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
/// Laid out like a PointCloud2 with fields x y z rgb confidence and a point_step of 20 bytes.
struct ColoredPoint
{
  float x;              ///< metres
  float y;              ///< metres
  float z;              ///< metres
  std::uint8_t b;       ///< blue
  std::uint8_t g;       ///< green
  std::uint8_t r;       ///< red
  std::uint8_t unused;  ///< fills the bytes of rgb
  float confidence;     ///< 0..1
};
static_assert(sizeof(ColoredPoint) == 20, "the clouds are written straight into message buffers");

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

/// A point of the dense cloud, in the optical frame of the reference view.
struct DensePoint
{
  float x;             ///< metres
  float y;             ///< metres
  float z;             ///< metres
  float normal_x;      ///< of the surface, of length 1, towards the camera
  float normal_y;      ///< likewise
  float normal_z;      ///< likewise
  std::uint8_t r;      ///< red
  std::uint8_t g;      ///< green
  std::uint8_t b;      ///< blue
  std::uint8_t views;  ///< maps, each solved in a view of its own, that agree on the point
  float confidence;    ///< 0..1, the mean of the maps that agree
};
static_assert(sizeof(DensePoint) == 32, "files and messages are filled with whole points");

/// Which points the dense cloud has.
struct DenseCloudOptions
{
  /// Maps that are solved, each in a view of its own, and fused: the reference's and those of views far from
  /// it. With one, everything comes from the reference's; 3 and 5 also hold what the reference does not see
  /// and drop what they contradict each other in, for as many times the work.
  int maps = 1;
  /// For those with time: what `estimate` takes for the cloud in a file.
  static constexpr int MAPS_WITH_TIME = 5;
  /// Of one map, points of lower confidence are left out; of several, two must agree, and the nearest map be
  /// so sure, or the weights add up to five times that. Raise it when the cloud has stray points.
  float min_confidence = 0.1F;
  /// Edge of the cubes inside which points are merged into their mean, weighted by confidence, in metres; 0
  /// keeps every point. Raise it when the cloud is too large to transport or to show.
  float voxel_size_m = 0.0F;
  /// A merged point needs points of so many views.
  int min_views = 2;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const DenseCloudOptions& options);

/// Receives the points block after block, on the calling thread; what it throws comes out of the function
/// that makes the cloud.
using DensePointSink = std::function<void(const DensePoint* points, std::size_t count)>;

/// The extra dense cloud (paper, 3.3.2): the maps are brought to every view, and each pixel on which enough
/// of them agree, and that none of them sees through, is unprojected with the centre and the colour of its
/// own camera. No NaN in it; the points and their order depend on nothing but the input. Memory grows with
/// the threads, not with the views.
/// @param maps of different views, the reference's first, as an Estimator gives them
/// @param sink asked once for each view, or in the end where points are merged
/// @pre light_field.calibration is set
/// @pre validate(options) is empty
void denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                const DenseCloudOptions& options, ThreadPool& pool, const DensePointSink& sink);

/// The same, into a vector.
std::vector<DensePoint> denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                   const DenseCloudOptions& options, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_POINT_CLOUD_H
