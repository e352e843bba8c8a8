#include "light_field_depth/core/view_maps.h"

#include <algorithm>
#include <cmath>

#include "core/cloud/batch_fusion.h"
#include "core/cloud/surface_fusion.h"
#include "core/cloud/surface_map.h"

namespace light_field_depth
{
namespace
{
/// A row or a column of a map.
struct Line
{
  float* values;
  std::size_t stride;
  int count;

  float& at(int i) const { return values[static_cast<std::size_t>(i) * stride]; }
};

/// What is unknown takes the farther of the two ends of its gap.
void fillLine(const Line& line)
{
  for (int i = 0; i < line.count;)
  {
    int end = i;
    while (end < line.count && std::isnan(line.at(end)))
    {
      ++end;
    }
    if (end > i && (i > 0 || end < line.count))
    {
      const float before = line.at(i > 0 ? i - 1 : end);
      const float after = line.at(end < line.count ? end : i - 1);
      for (int k = i; k < end; ++k)
      {
        line.at(k) = std::min(before, after);
      }
    }
    i = end + 1;
  }
}

void fillRows(cv::Mat& disparity)
{
  for (int y = 0; y < disparity.rows; ++y)
  {
    fillLine({disparity.ptr<float>(y), 1, disparity.cols});
  }
}

void fillColumns(cv::Mat& disparity)
{
  for (int x = 0; x < disparity.cols; ++x)
  {
    fillLine({disparity.ptr<float>() + x, disparity.step1(), disparity.rows});
  }
}

/// Along the direction in which the view moved: what it sees beside an edge continues there.
void fill(const View& view, float lowest, cv::Mat& disparity)
{
  const bool along_rows = std::abs(view.steps.x) >= std::abs(view.steps.y);
  along_rows ? fillRows(disparity) : fillColumns(disparity);
  along_rows ? fillColumns(disparity) : fillRows(disparity);
  disparity.setTo(lowest, cloud::unknownPixels(disparity));  // the view shows nothing that any map does
}

void takeRow(int y, const cloud::FusedRow& fused, ViewMap& map)
{
  std::copy(fused.disparity.begin(), fused.disparity.end(), map.disparity.ptr<float>(y));
  auto* const confidence = map.confidence.ptr<float>(y);
  auto* const origin = map.origin.ptr<std::uint8_t>(y);
  for (std::size_t x = 0; x < fused.disparity.size(); ++x)
  {
    const bool filled = std::isnan(fused.disparity[x]);
    const ViewPixel from = filled                   ? ViewPixel::Filled
                           : fused.by_first[x] != 0 ? ViewPixel::Seen
                                                    : ViewPixel::Solved;
    origin[x] = static_cast<std::uint8_t>(from);
    confidence[x] = filled ? 0.0F : fused.confidence[x];
  }
}

}  // namespace

void viewMaps(const LightField& light_field, const std::vector<ViewDisparity>& maps,
              const DenseCloudOptions& options, ThreadPool& pool, const ViewMapSink& sink)
{
  if (maps.empty())
  {
    return;
  }
  double lowest = 0.0;
  cv::minMaxIdx(maps.front().disparity, &lowest);
  const cloud::BatchFusion fusion(light_field, maps, pool);
  std::vector<ViewMap> view_maps(fusion.slots());
  fusion.run(
      options.min_confidence,
      [&](const View& view, std::size_t slot, const cloud::BatchFusion::FusedRows& rows)
      {
        ViewMap& map = view_maps[slot];
        map.disparity.create(maps.front().disparity.size(), CV_32FC1);
        map.confidence.create(map.disparity.size(), CV_32FC1);
        map.origin.create(map.disparity.size(), CV_8UC1);
        rows([&](int y, const cloud::FusedRow& row) { takeRow(y, row, map); });
        fill(view, static_cast<float>(lowest), map.disparity);
      },
      [&](std::size_t first, std::size_t count)
      {
        for (std::size_t slot = 0; slot < count; ++slot)
        {
          view_maps[slot].view_index = first + slot;
          sink(view_maps[slot]);
        }
      });
}

}  // namespace light_field_depth
