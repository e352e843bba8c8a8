#include "core/cloud/surface_warp.h"

#include <cmath>

#include "core/cloud/cloud_kernels.h"

namespace light_field_depth::cloud
{
namespace
{
/// Disparities that differ by less belong to one surface. Set by hand, the same as for the votes of the
/// fusion.
constexpr float SAME_SURFACE = 0.015F;

/// Closes a gap of one pixel between two pixels of one surface.
void closeGap(WarpedSurface& warped, const Tolerance& tolerance, int before, int here, int after)
{
  auto* const source = warped.source.ptr<std::int32_t>();
  auto* const disparity = warped.disparity.ptr<float>();
  if (source[before] < 0 || source[after] < 0)
  {
    return;
  }
  if (std::abs(disparity[before] - disparity[after]) <= tolerance.gap(disparity[before], SAME_SURFACE))
  {
    disparity[here] = 0.5F * (disparity[before] + disparity[after]);
    source[here] = source[before];
  }
}

void closeGaps(WarpedSurface& warped, const Tolerance& tolerance)
{
  const int columns = warped.source.cols;
  const int rows = warped.source.rows;
  for (int y = 0; y < rows; ++y)
  {
    const auto* const source = warped.source.ptr<std::int32_t>(y);
    for (int x = 0; x < columns; ++x)
    {
      if (source[x] >= 0)
      {
        continue;
      }
      const int here = y * columns + x;
      if (x > 0 && x + 1 < columns)
      {
        closeGap(warped, tolerance, here - 1, here, here + 1);
      }
      if (source[x] < 0 && y > 0 && y + 1 < rows)
      {
        closeGap(warped, tolerance, here - columns, here, here + columns);
      }
    }
  }
}

}  // namespace

void warpSurface(const SurfaceMap& map, const View& view, const Tolerance& tolerance, WarpedSurface& warped)
{
  const cv::Size size = map.disparity.size();
  warped.disparity.create(size, CV_32FC1);
  warped.source.create(size, CV_32SC1);
  warped.distance.create(size, CV_32FC1);
  warped.source.setTo(WarpedSurface::NOTHING_HERE);
  const cv::Point2f steps = view.steps - map.steps;
  const cv::Point2f offset = view.offset_px - map.offset_px;
  warped.row_target.create(1, size.width, CV_32SC1);
  warped.row_there.create(1, size.width, CV_32FC1);
  warped.row_distance.create(1, size.width, CV_32FC1);
  ProjectedRow row;
  row.width = size.width;
  row.height = size.height;
  row.begin_x = offset.x + 0.5F;  // half a pixel more: the conversion to an integer then rounds
  row.steps_x = steps.x;
  row.steps_y = steps.y;
  row.target = warped.row_target.ptr<std::int32_t>();
  row.there = warped.row_there.ptr<float>();
  row.distance = warped.row_distance.ptr<float>();
  auto* const to_disparity = warped.disparity.ptr<float>();
  auto* const to_source = warped.source.ptr<std::int32_t>();
  auto* const to_distance = warped.distance.ptr<float>();
  for (int y = 0; y < size.height; ++y)
  {
    row.disparity = map.disparity.ptr<float>(y);
    row.confidence = map.confidence.ptr<float>(y);
    row.slope_x = map.slope_x.ptr<float>(y);
    row.slope_y = map.slope_y.ptr<float>(y);
    row.begin_y = static_cast<float>(y) + offset.y + 0.5F;
    projectRow(row);
    for (int x = 0; x < size.width; ++x)
    {
      const std::int32_t target = row.target[x];
      if (target < 0)
      {
        continue;
      }
      const float there = row.there[x];
      const float distance = row.distance[x];
      if (to_source[target] >= 0)
      {
        const float ahead = there - to_disparity[target];
        const float same = tolerance.gap(there, SAME_SURFACE);
        const bool better = ahead > same || (ahead > -same && distance < to_distance[target]);
        if (!better)
        {
          continue;
        }
      }
      to_disparity[target] = there;
      to_source[target] = y * size.width + x;
      to_distance[target] = distance;
    }
  }
  closeGaps(warped, tolerance);
}

}  // namespace light_field_depth::cloud
