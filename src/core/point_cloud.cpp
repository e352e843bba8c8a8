#include "light_field_depth/core/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"

namespace light_field_depth
{
namespace
{
constexpr int ROWS_PER_CHUNK = 16;

/// The camera of one view as the unprojection needs it, in the frame of the reference view.
struct ViewCamera
{
  double focal_length_px;
  cv::Point2d principal_point_px;
  cv::Point2d centre_m;
};

ViewCamera cameraOf(const View& view, const Calibration& calibration)
{
  // A point at depth Z moves by -steps * (d + d_inf) through parallax and by +steps * d_inf + offset_px
  // through the principal point.
  ViewCamera camera;
  camera.focal_length_px = calibration.focal_length_px;
  camera.principal_point_px =
      calibration.principal_point_px + view.steps * calibration.disparity_offset_px + view.offset_px;
  camera.centre_m = view.steps * calibration.baseline_m;
  return camera;
}

/// Reads one row of colours as b, g, r of 8 bits.
class ColorReader
{
public:
  explicit ColorReader(const cv::Mat& image) : image_(image), channels_(image.channels()) {}

  void paint(int y, int x, ColoredPoint& point) const
  {
    const std::uint8_t* const pixel =
        image_.ptr<std::uint8_t>(y) + static_cast<std::ptrdiff_t>(x) * channels_;
    point.b = pixel[0];
    point.g = pixel[channels_ == 3 ? 1 : 0];
    point.r = pixel[channels_ == 3 ? 2 : 0];
    point.unused = 0;
  }

private:
  const cv::Mat& image_;
  int channels_;
};

bool isTrusted(const cv::Mat& confidence, int y, int x, float min_confidence)
{
  return confidence.empty() || confidence.at<float>(y, x) >= min_confidence;
}

/// Sets x, y, z; false and NaN where the disparity gives no depth.
bool unproject(const ViewCamera& camera, const Calibration& calibration, int x, int y, float disparity,
               ColoredPoint& point)
{
  const float z = depthFromDisparity(disparity, calibration);
  point.z = z;
  point.x =
      static_cast<float>(camera.centre_m.x + (x - camera.principal_point_px.x) * z / camera.focal_length_px);
  point.y =
      static_cast<float>(camera.centre_m.y + (y - camera.principal_point_px.y) * z / camera.focal_length_px);
  return std::isfinite(z);
}

/// The points of rows [first, last) of one view that have a depth and are trusted, in row-major order.
void appendRows(const View& view, const Calibration& calibration, const ViewDisparity& map,
                float min_confidence, int first, int last, std::vector<ColoredPoint>& points)
{
  const ViewCamera camera = cameraOf(view, calibration);
  const ColorReader colors(view.image);
  for (int y = first; y < last; ++y)
  {
    for (int x = 0; x < map.disparity.cols; ++x)
    {
      ColoredPoint point{};
      if (isTrusted(map.confidence, y, x, min_confidence) &&
          unproject(camera, calibration, x, y, map.disparity.at<float>(y, x), point))
      {
        colors.paint(y, x, point);
        points.push_back(point);
      }
    }
  }
}

struct VoxelKey
{
  std::int64_t x;
  std::int64_t y;
  std::int64_t z;
  bool operator==(const VoxelKey& other) const { return x == other.x && y == other.y && z == other.z; }
};

struct VoxelHash
{
  std::size_t operator()(const VoxelKey& key) const
  {
    const std::uint64_t mixed = static_cast<std::uint64_t>(key.x) * 0x9E3779B97F4A7C15ULL ^
                                static_cast<std::uint64_t>(key.y) * 0xC2B2AE3D27D4EB4FULL ^
                                static_cast<std::uint64_t>(key.z) * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(mixed ^ (mixed >> 29));
  }
};

struct VoxelSum
{
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  std::uint32_t b = 0;
  std::uint32_t g = 0;
  std::uint32_t r = 0;
  std::uint32_t count = 0;

  void add(const ColoredPoint& point)
  {
    x += point.x;
    y += point.y;
    z += point.z;
    b += point.b;
    g += point.g;
    r += point.r;
    ++count;
  }

  ColoredPoint mean() const
  {
    const auto level = [this](std::uint32_t sum)
    { return static_cast<std::uint8_t>((sum + count / 2) / count); };
    return {static_cast<float>(x / count),
            static_cast<float>(y / count),
            static_cast<float>(z / count),
            level(b),
            level(g),
            level(r),
            0};
  }
};

/// The mean of the points of each voxel, voxels in the order of their first points.
std::vector<ColoredPoint> mergeVoxels(const std::vector<ColoredPoint>& points, float voxel_size_m)
{
  const double scale = 1.0 / voxel_size_m;
  std::unordered_map<VoxelKey, std::size_t, VoxelHash> index_of;
  index_of.reserve(points.size() / 4);
  std::vector<VoxelSum> sums;
  for (const ColoredPoint& point : points)
  {
    const VoxelKey key = {static_cast<std::int64_t>(std::floor(point.x * scale)),
                          static_cast<std::int64_t>(std::floor(point.y * scale)),
                          static_cast<std::int64_t>(std::floor(point.z * scale))};
    const auto [entry, inserted] = index_of.try_emplace(key, sums.size());
    if (inserted)
    {
      sums.emplace_back();
    }
    sums[entry->second].add(point);
  }
  std::vector<ColoredPoint> merged;
  merged.reserve(sums.size());
  for (const VoxelSum& sum : sums)
  {
    merged.push_back(sum.mean());
  }
  return merged;
}

}  // namespace

void unprojectReference(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                        float min_confidence, ThreadPool& pool, ColoredPoint* points)
{
  const LightField shown = toEightBit(light_field);
  const Calibration& calibration = *shown.calibration;
  const ViewCamera camera = cameraOf(shown.reference(), calibration);
  const ColorReader colors(shown.reference().image);
  constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       ColoredPoint* const row = points + static_cast<std::ptrdiff_t>(y) * disparity.cols;
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const bool trusted = isTrusted(confidence, y, x, min_confidence);
                         unproject(camera, calibration, x, y, trusted ? disparity.at<float>(y, x) : NaN,
                                   row[x]);
                         colors.paint(y, x, row[x]);
                       }
                     }
                   });
}

std::vector<std::string> validate(const DenseCloudOptions& options)
{
  std::vector<std::string> problems;
  if (!(options.min_confidence >= 0.0F && options.min_confidence <= 1.0F))
  {
    problems.push_back("dense_cloud.min_confidence is " + std::to_string(options.min_confidence) +
                       "; it must be between 0 and 1.");
  }
  if (!(options.voxel_size_m >= 0.0F) || std::isinf(options.voxel_size_m))
  {
    problems.push_back("dense_cloud.voxel_size_m is " + std::to_string(options.voxel_size_m) +
                       "; it must be 0 (keep every point) or a positive length in metres.");
  }
  return problems;
}

std::vector<ColoredPoint> denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                     const DenseCloudOptions& options, ThreadPool& pool)
{
  const LightField shown = toEightBit(light_field);
  std::vector<std::vector<ColoredPoint>> parts(maps.size());
  pool.parallelFor(0, static_cast<int>(maps.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       const ViewDisparity& map = maps[static_cast<std::size_t>(i)];
                       appendRows(shown.views[map.view_index], *shown.calibration, map,
                                  options.min_confidence, 0, map.disparity.rows,
                                  parts[static_cast<std::size_t>(i)]);
                     }
                   });
  std::vector<ColoredPoint> points;
  std::size_t count = 0;
  for (const auto& part : parts)
  {
    count += part.size();
  }
  points.reserve(count);
  for (const auto& part : parts)
  {
    points.insert(points.end(), part.begin(), part.end());
  }
  return options.voxel_size_m > 0.0F ? mergeVoxels(points, options.voxel_size_m) : points;
}

}  // namespace light_field_depth
