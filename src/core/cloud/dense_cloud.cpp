#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/batch_fusion.h"
#include "core/cloud/cloud_kernels.h"
#include "core/cloud/surface_fusion.h"
#include "core/cloud/surface_map.h"
#include "core/cloud/unprojection.h"
#include "core/cloud/voxel_merger.h"
#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth
{
namespace
{
/// Points of one view, in single precision: a point is as exact as a float of metres.
class ViewPoints
{
public:
  ViewPoints(const View& view, const Calibration& calibration)
      : image_(view.image), colour_(static_cast<std::size_t>(view.image.cols)),
        place_(FLOATS_OF_HALF * colour_.size()), look_(place_.size())
  {
    const cloud::ViewCamera camera = cloud::cameraOf(view, calibration);
    principal_y_px_ = static_cast<float>(camera.principal_point_px.y);
    row_.width = view.image.cols;
    row_.offset_px = static_cast<float>(calibration.disparity_offset_px);
    row_.focal_length_px = static_cast<float>(calibration.focal_length_px);
    row_.focal_times_baseline = static_cast<float>(calibration.focal_length_px * calibration.baseline_m);
    row_.principal_x_px = static_cast<float>(camera.principal_point_px.x);
    row_.centre_x_m = static_cast<float>(camera.centre_m.x);
    row_.centre_y_m = static_cast<float>(camera.centre_m.y);
    row_.colour = colour_.data();
    row_.place = place_.data();
    row_.look = look_.data();
  }

  /// Appends the points of a row. @param point room for one more than the row has
  /// @return the end of what was written
  DensePoint* write(int y, const cloud::FusedRow& fused, DensePoint* point)
  {
    row_.disparity = fused.disparity.data();
    row_.slope_x = fused.slope_x.data();
    row_.slope_y = fused.slope_y.data();
    row_.confidence = fused.confidence.data();
    row_.row_px = static_cast<float>(y) - principal_y_px_;
    takeColours(y, fused.votes);
    cloud::unprojectRow(row_);
    // What is no point is written over by the next one.
    const float* place = row_.place;
    const float* look = row_.look;
    for (int x = 0; x < row_.width; ++x, place += FLOATS_OF_HALF, look += FLOATS_OF_HALF)
    {
      std::memcpy(&point->x, place, sizeof(float) * FLOATS_OF_HALF);
      std::memcpy(&point->normal_y, look, sizeof(float) * FLOATS_OF_HALF);
      point += place[2] > 0.0F ? 1 : 0;
    }
    return point;
  }

private:
  static constexpr std::size_t FLOATS_OF_HALF = 4;

  /// As a point has them in its memory.
  void takeColours(int y, const std::vector<std::uint8_t>& votes)
  {
    const auto* pixel = image_.ptr<std::uint8_t>(y);
    const int channels = image_.channels();
    const int green = channels == 3 ? 1 : 0;
    const int red = channels == 3 ? 2 : 0;
    const std::uint8_t* vote = votes.data();
    std::uint32_t* colour = colour_.data();
    for (int x = 0; x < row_.width; ++x, pixel += channels)
    {
      const std::array<std::uint8_t, sizeof(std::uint32_t)> bytes = {pixel[red], pixel[green], pixel[0],
                                                                     *vote++};
      std::memcpy(colour++, bytes.data(), bytes.size());
    }
  }

  const cv::Mat& image_;
  std::vector<std::uint32_t> colour_;
  std::vector<float> place_;
  std::vector<float> look_;
  cloud::UnprojectedRow row_;
  float principal_y_px_ = 0.0F;
};

void unproject(const cloud::BatchFusion::FusedRows& rows, const View& view, const Calibration& calibration,
               std::vector<DensePoint>& points)
{
  ViewPoints view_points(view, calibration);
  points.resize(view.image.total() + 1);
  DensePoint* point = points.data();
  rows([&](int y, const cloud::FusedRow& row) { point = view_points.write(y, row, point); });
  points.resize(static_cast<std::size_t>(point - points.data()));
}

}  // namespace

std::vector<std::string> validate(const DenseCloudOptions& options)
{
  std::vector<std::string> problems;
  if (options.maps < 1 || options.maps > static_cast<int>(cloud::MAX_FUSED_MAPS))
  {
    problems.push_back("dense_maps is " + std::to_string(options.maps) + "; it must be between 1 and " +
                       std::to_string(cloud::MAX_FUSED_MAPS) + ".");
  }
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
  if (options.min_views < 1)
  {
    problems.push_back("dense_cloud.min_views is " + std::to_string(options.min_views) +
                       "; it must be at least 1.");
  }
  return problems;
}

void denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                const DenseCloudOptions& options, ThreadPool& pool, const DensePointSink& sink)
{
  if (maps.empty())
  {
    return;
  }
  const LightField shown = toEightBit(light_field);
  const cloud::BatchFusion fusion(shown, maps, pool);
  std::optional<cloud::VoxelMerger> merger;
  if (options.voxel_size_m > 0.0F)
  {
    merger.emplace(options.voxel_size_m);
  }
  std::vector<std::vector<DensePoint>> points(fusion.slots());
  std::vector<cloud::VoxelMerger::Part> parts(merger ? fusion.slots() : 0);
  fusion.run(
      options.min_confidence,
      [&](const View& view, std::size_t slot, const cloud::BatchFusion::FusedRows& rows)
      {
        unproject(rows, view, *shown.calibration, points[slot]);
        if (merger)
        {
          merger->sumUp(points[slot], parts[slot]);
        }
      },
      [&](std::size_t /*first*/, std::size_t count)
      {
        if (merger)
        {
          merger->add(parts, count, pool);
          return;
        }
        for (std::size_t slot = 0; slot < count; ++slot)
        {
          if (!points[slot].empty())
          {
            sink(points[slot].data(), points[slot].size());
          }
        }
      });
  if (merger)
  {
    merger->emit(static_cast<std::uint32_t>(
                     std::min<std::size_t>(static_cast<std::size_t>(options.min_views), shown.views.size())),
                 sink);
  }
}

std::vector<DensePoint> denseCloud(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                   const DenseCloudOptions& options, ThreadPool& pool)
{
  std::vector<DensePoint> points;
  denseCloud(light_field, maps, options, pool,
             [&points](const DensePoint* block, std::size_t count)
             { points.insert(points.end(), block, block + count); });
  return points;
}

}  // namespace light_field_depth
