#include "light_field_depth/core/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/cloud/voxel_merger.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// Rows of one part of VoxelMerger. Set by hand; the order of sums, and so the last bits of a point, depend
/// on it.
constexpr int ROWS_PER_MERGED_BAND = 8;

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

/// Rays of one row of one view's pixels: x, y of the points at depth 1, and what is added to them.
class RowUnprojection
{
public:
  RowUnprojection(const View& view, const Calibration& calibration)
      : camera_(cameraOf(view, calibration)), colors_(view.image),
        focal_times_baseline_(calibration.focal_length_px * calibration.baseline_m),
        disparity_offset_px_(calibration.disparity_offset_px), ray_step_(1.0 / calibration.focal_length_px)
  {
  }

  /// Whether a disparity gives a depth. As in depthFromDisparity().
  bool isFinite(float disparity) const { return std::isfinite(depthOf(disparity)); }

  /// x, y, z and the colour of one pixel; NaN where the disparity gives no depth.
  ColoredPoint point(int y, int x, float disparity) const
  {
    const float z = depthOf(disparity);
    ColoredPoint point;
    point.x = static_cast<float>(camera_.centre_m.x + (x - camera_.principal_point_px.x) * ray_step_ * z);
    point.y = static_cast<float>(camera_.centre_m.y + (y - camera_.principal_point_px.y) * ray_step_ * z);
    point.z = z;
    colors_.paint(y, x, point);
    return point;
  }

private:
  float depthOf(float disparity) const
  {
    const double absolute = disparity + disparity_offset_px_;
    const bool valid = absolute > 0.0 && absolute <= std::numeric_limits<double>::max();
    const auto depth = static_cast<float>(focal_times_baseline_ / absolute);
    return valid ? depth : std::numeric_limits<float>::quiet_NaN();
  }

  ViewCamera camera_;
  ColorReader colors_;
  double focal_times_baseline_;
  double disparity_offset_px_;
  double ray_step_;
};

/// Rows of one view, the unit of the work on all views.
struct Chunk
{
  std::size_t map;
  int first_row;
  int last_row;
};

std::vector<Chunk> chunksOf(const std::vector<ViewDisparity>& maps)
{
  std::vector<Chunk> chunks;
  for (std::size_t map = 0; map < maps.size(); ++map)
  {
    for (int row = 0; row < maps[map].disparity.rows; row += ROWS_PER_CHUNK)
    {
      chunks.push_back({map, row, std::min(row + ROWS_PER_CHUNK, maps[map].disparity.rows)});
    }
  }
  return chunks;
}

/// Every pixel of every view that has a depth and is trusted.
class TrustedPixels
{
public:
  TrustedPixels(const LightField& light_field, const std::vector<ViewDisparity>& maps, float min_confidence)
      : maps_(maps), min_confidence_(min_confidence)
  {
    for (const ViewDisparity& map : maps)
    {
      unprojections_.emplace_back(light_field.views[map.view_index], *light_field.calibration);
    }
  }

  std::size_t count(const Chunk& chunk) const
  {
    const RowUnprojection& unprojection = unprojections_[chunk.map];
    std::size_t count = 0;
    forEach(chunk, [&](int, int, float disparity, bool trusted)
            { count += static_cast<std::size_t>(trusted && unprojection.isFinite(disparity)); });
    return count;
  }

  /// The points in row-major order. @return the end of what was written
  ColoredPoint* write(const Chunk& chunk, ColoredPoint* points) const
  {
    const RowUnprojection& unprojection = unprojections_[chunk.map];
    forEach(chunk,
            [&](int y, int x, float disparity, bool trusted)
            {
              if (trusted && unprojection.isFinite(disparity))
              {
                *points++ = unprojection.point(y, x, disparity);
              }
            });
    return points;
  }

private:
  template <class Visit>
  void forEach(const Chunk& chunk, const Visit& visit) const
  {
    const ViewDisparity& map = maps_[chunk.map];
    for (int y = chunk.first_row; y < chunk.last_row; ++y)
    {
      const auto* const disparity = map.disparity.ptr<float>(y);
      const float* const confidence = map.confidence.empty() ? nullptr : map.confidence.ptr<float>(y);
      for (int x = 0; x < map.disparity.cols; ++x)
      {
        visit(y, x, disparity[x], confidence == nullptr || confidence[x] >= min_confidence_);
      }
    }
  }

  const std::vector<ViewDisparity>& maps_;
  std::vector<RowUnprojection> unprojections_;
  float min_confidence_;
};

void writeEveryPoint(const TrustedPixels& pixels, const std::vector<Chunk>& chunks, ThreadPool& pool,
                     const PointAllocator& room)
{
  std::vector<std::size_t> begins(chunks.size() + 1, 0);
  const auto forEachChunk = [&](const std::function<void(std::size_t)>& body)
  {
    pool.parallelFor(0, static_cast<int>(chunks.size()), 1,
                     [&](int first, int /*last*/) { body(static_cast<std::size_t>(first)); });
  };
  forEachChunk([&](std::size_t i) { begins[i + 1] = pixels.count(chunks[i]); });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  ColoredPoint* const points = room(begins.back());
  if (points == nullptr)
  {
    return;
  }
  forEachChunk([&](std::size_t i) { pixels.write(chunks[i], points + begins[i]); });
}

/// Merges the same rows of all views first, since they see much the same places.
void writeMergedPoints(const TrustedPixels& pixels, const std::vector<ViewDisparity>& maps,
                       float voxel_size_m, ThreadPool& pool, const PointAllocator& room)
{
  const cv::Size size = maps.empty() ? cv::Size() : maps.front().disparity.size();
  const int bands = (size.height + ROWS_PER_MERGED_BAND - 1) / ROWS_PER_MERGED_BAND;
  VoxelMerger merger(static_cast<std::size_t>(bands), voxel_size_m);
  pool.parallelFor(0, bands, 1,
                   [&](int band, int /*end*/)
                   {
                     const int first_row = band * ROWS_PER_MERGED_BAND;
                     const int last_row = std::min(first_row + ROWS_PER_MERGED_BAND, size.height);
                     VoxelMerger::Table table(merger);
                     std::vector<ColoredPoint> row(static_cast<std::size_t>(size.width));
                     for (std::size_t map = 0; map < maps.size(); ++map)
                     {
                       for (int y = first_row; y < last_row; ++y)
                       {
                         table.add(row.data(), pixels.write({map, y, y + 1}, row.data()));
                       }
                     }
                     table.store(static_cast<std::size_t>(band));
                   });
  merger.merge(pool, room);
}

}  // namespace

void unprojectReference(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                        float min_confidence, ThreadPool& pool, ColoredPoint* points)
{
  const LightField shown = toEightBit(light_field);
  const RowUnprojection unprojection(shown.reference(), *shown.calibration);
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
                         row[x] = unprojection.point(y, x, trusted ? disparity.at<float>(y, x) : NaN);
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

void denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                const DenseCloudOptions& options, ThreadPool& pool, const PointAllocator& room)
{
  const LightField shown = toEightBit(light_field);
  const TrustedPixels pixels(shown, maps, options.min_confidence);
  if (options.voxel_size_m > 0.0F)
  {
    writeMergedPoints(pixels, maps, options.voxel_size_m, pool, room);
  }
  else
  {
    writeEveryPoint(pixels, chunksOf(maps), pool, room);
  }
}

std::vector<ColoredPoint> denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                     const DenseCloudOptions& options, ThreadPool& pool)
{
  std::vector<ColoredPoint> points;
  denseCloud(light_field, maps, options, pool,
             [&points](std::size_t count)
             {
               points.resize(count);
               return points.data();
             });
  return points;
}

}  // namespace light_field_depth
