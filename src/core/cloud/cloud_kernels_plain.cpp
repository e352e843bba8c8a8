#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "core/cloud/cloud_kernels.h"

namespace light_field_depth::cloud
{
namespace
{
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
}  // namespace

void projectRowPlain(const ProjectedRow& row)
{
  const auto width = static_cast<float>(row.width);
  const auto height = static_cast<float>(row.height);
  for (int x = 0; x < row.width; ++x)
  {
    const float d = row.disparity[x];
    const float at_x = static_cast<float>(x) + row.begin_x - d * row.steps_x;
    const float at_y = row.begin_y - d * row.steps_y;
    row.target[x] = -1;
    if (at_x >= 0.0F && at_x < width && at_y >= 0.0F && at_y < height)
    {
      const auto column = static_cast<std::int32_t>(at_x);
      const auto line = static_cast<std::int32_t>(at_y);
      const float gap_x = static_cast<float>(column) + 0.5F - at_x;
      const float gap_y = static_cast<float>(line) + 0.5F - at_y;
      const float squeeze = compression(row.slope_x[x], row.slope_y[x], row.steps_x, row.steps_y);
      const float rise = gap_x * row.slope_x[x] + gap_y * row.slope_y[x];
      row.target[x] = (line & row.row_mask) * row.width + column;
      row.there[x] = squeeze > MIN_COMPRESSION ? d + rise / squeeze : d;
    }
  }
}

void agreeInRowPlain(const AgreedRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    bool all = true;
    float lowest = std::numeric_limits<float>::infinity();
    float highest = -lowest;
    for (int i = 0; i < row.count; ++i)
    {
      all = all && row.maps[i].source[x] >= 0;
      lowest = std::min(lowest, row.maps[i].disparity[x]);
      highest = std::max(highest, row.maps[i].disparity[x]);
    }
    const float gap = std::max(row.same_surface * (lowest + row.offset_px), row.floor_px);
    const bool agreed = all && highest - lowest <= gap;
    row.done[x] = agreed || row.count == 1 ? 1 : 0;
    row.disparity[x] = NaN;
    if (!agreed)
    {
      continue;
    }
    float rise = 0.0F;
    float trust = 0.0F;
    float weight = 0.0F;
    float heaviest = -1.0F;
    bool sure = false;
    int best = 0;
    const float first = row.maps[0].disparity[x];
    for (int i = 0; i < row.count; ++i)
    {
      const MapOfRow& map = row.maps[i];
      const float confidence = map.confidence[map.source[x]];
      const float of_map = (row.least_weight + confidence) * map.nearness;
      rise += of_map * (map.disparity[x] - first);
      trust += of_map * confidence;
      weight += of_map;
      sure = sure || (map.nearness >= row.nearest && confidence >= row.min_confidence);
      best = of_map > heaviest ? i : best;
      heaviest = std::max(heaviest, of_map);
    }
    if (weight >= row.min_weight || sure)
    {
      const MapOfRow& map = row.maps[best];
      const float slope_x = map.slope_x[map.source[x]];
      const float slope_y = map.slope_y[map.source[x]];
      const float squeeze = compression(slope_x, slope_y, map.steps_x, map.steps_y);
      const float stretch = squeeze > MIN_COMPRESSION ? 1.0F / squeeze : 1.0F;
      const float scale = 1.0F / weight;
      row.disparity[x] = first + rise * scale;
      row.confidence[x] = row.count == 1 ? map.confidence[map.source[x]] : trust * scale;
      row.slope_x[x] = slope_x * stretch;
      row.slope_y[x] = slope_y * stretch;
    }
  }
}

void unprojectRowPlain(const UnprojectedRow& row)
{
  const float ray_step = 1.0F / row.focal_length_px;
  for (int x = 0; x < row.width; ++x)
  {
    const float absolute = row.disparity[x] + row.offset_px;
    const float z = row.focal_times_baseline / absolute;
    float* const place = row.place + 4 * static_cast<std::ptrdiff_t>(x);
    float* const look = row.look + 4 * static_cast<std::ptrdiff_t>(x);
    place[2] = 0.0F;
    if (absolute > 0.0F && z <= std::numeric_limits<float>::max())
    {
      // 1 / Z is linear in the pixel: f B / Z = absolute + slope . (p - p0). With p = c + f X / Z this is a
      // plane.
      const float column = static_cast<float>(x) - row.principal_x_px;
      const float at_centre = absolute - row.slope_x[x] * column - row.slope_y[x] * row.row_px;
      const float normal_x = row.focal_length_px * row.slope_x[x];
      const float normal_y = row.focal_length_px * row.slope_y[x];
      const float scale =
          -1.0F / std::sqrt(normal_x * normal_x + normal_y * normal_y + at_centre * at_centre);
      place[0] = row.centre_x_m + column * ray_step * z;
      place[1] = row.centre_y_m + row.row_px * ray_step * z;
      place[2] = z;
      place[3] = scale * normal_x;
      look[0] = scale * normal_y;
      look[1] = scale * at_centre;
      std::memcpy(look + 2, row.colour + x, sizeof(float));
      look[3] = row.confidence[x];
    }
  }
}

}  // namespace light_field_depth::cloud
