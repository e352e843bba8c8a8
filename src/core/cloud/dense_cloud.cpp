#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/batch_fusion.h"
#include "core/cloud/surface_fusion.h"
#include "core/cloud/surface_map.h"
#include "core/cloud/unprojection.h"
#include "core/cloud/voxel_merger.h"
#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth
{
namespace
{
/// The direction of a plane of disparities: n . (X - C) = f B for all its points.
/// @param absolute d + d_inf at the pixel
class NormalOfSlope
{
public:
  NormalOfSlope(const View& view, const Calibration& calibration)
      : focal_length_px_(static_cast<float>(calibration.focal_length_px)),
        principal_point_px_(cloud::cameraOf(view, calibration).principal_point_px)
  {
  }

  void set(int x, int y, float absolute, float slope_x, float slope_y, DensePoint& point) const
  {
    // 1 / Z is linear in the pixel: f B / Z = absolute + slope . (p - p0). With p = c + f X / Z this is a
    // plane.
    const float at_centre = absolute - slope_x * (static_cast<float>(x) - principal_point_px_.x) -
                            slope_y * (static_cast<float>(y) - principal_point_px_.y);
    const float normal_x = focal_length_px_ * slope_x;
    const float normal_y = focal_length_px_ * slope_y;
    const float scale = -1.0F / std::sqrt(normal_x * normal_x + normal_y * normal_y + at_centre * at_centre);
    point.normal_x = scale * normal_x;
    point.normal_y = scale * normal_y;
    point.normal_z = scale * at_centre;
  }

private:
  float focal_length_px_;
  cv::Point2f principal_point_px_;
};

/// Points of one view, in single precision: a point is as exact as a float of metres.
class ViewPoints
{
public:
  ViewPoints(const View& view, const Calibration& calibration)
      : image_(view.image), normal_(view, calibration),
        offset_px_(static_cast<float>(calibration.disparity_offset_px)),
        focal_times_baseline_(static_cast<float>(calibration.focal_length_px * calibration.baseline_m)),
        ray_step_(static_cast<float>(1.0 / calibration.focal_length_px))
  {
    const cloud::ViewCamera camera = cloud::cameraOf(view, calibration);
    principal_point_px_ = camera.principal_point_px;
    centre_m_ = camera.centre_m;
  }

  /// Appends the points of a row. @return the end of what was written
  DensePoint* write(const cloud::FusedView& fused, int y, DensePoint* point) const
  {
    const auto* const disparity = fused.disparity.ptr<float>(y);
    const auto* const confidence = fused.confidence.ptr<float>(y);
    const auto* const slope_x = fused.slope_x.ptr<float>(y);
    const auto* const slope_y = fused.slope_y.ptr<float>(y);
    const auto* const votes = fused.votes.ptr<std::uint8_t>(y);
    const auto* pixel = image_.ptr<std::uint8_t>(y);
    const int channels = image_.channels();
    const int green = channels == 3 ? 1 : 0;
    const int red = channels == 3 ? 2 : 0;
    const float ray_y = (static_cast<float>(y) - principal_point_px_.y) * ray_step_;
    for (int x = 0; x < fused.disparity.cols; ++x, pixel += channels)
    {
      const float absolute = disparity[x] + offset_px_;
      const float z = focal_times_baseline_ / absolute;
      if (!(absolute > 0.0F && z <= std::numeric_limits<float>::max()))
      {
        continue;
      }
      point->x = centre_m_.x + (static_cast<float>(x) - principal_point_px_.x) * ray_step_ * z;
      point->y = centre_m_.y + ray_y * z;
      point->z = z;
      normal_.set(x, y, absolute, slope_x[x], slope_y[x], *point);
      point->confidence = confidence[x];
      point->b = pixel[0];
      point->g = pixel[green];
      point->r = pixel[red];
      point->views = votes[x];
      ++point;
    }
    return point;
  }

private:
  const cv::Mat& image_;
  NormalOfSlope normal_;
  cv::Point2f principal_point_px_;
  cv::Point2f centre_m_;
  float offset_px_;
  float focal_times_baseline_;
  float ray_step_;
};

void unproject(const cloud::FusedView& fused, const View& view, const Calibration& calibration,
               std::vector<DensePoint>& points)
{
  const ViewPoints view_points(view, calibration);
  points.resize(fused.disparity.total());
  DensePoint* point = points.data();
  for (int y = 0; y < fused.disparity.rows; ++y)
  {
    point = view_points.write(fused, y, point);
  }
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
      [&](const View& view, std::size_t slot, const cloud::FusedView& fused)
      {
        unproject(fused, view, *shown.calibration, points[slot]);
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
