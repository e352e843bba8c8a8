#include "light_field_depth/core/view_maps.h"

#include <algorithm>
#include <cmath>

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
  disparity.setTo(lowest, disparity != disparity);  // the view shows nothing that any map does
}

struct Slot
{
  cloud::FusionScratch scratch;
  cloud::FusedView fused;
  ViewMap map;
};

void makeMap(const View& view, float lowest, Slot& slot)
{
  slot.fused.disparity.copyTo(slot.map.disparity);
  slot.fused.confidence.copyTo(slot.map.confidence);
  slot.map.origin.create(slot.map.disparity.size(), CV_8UC1);
  for (int y = 0; y < slot.map.disparity.rows; ++y)
  {
    const auto* const disparity = slot.map.disparity.ptr<float>(y);
    const auto* const by_first = slot.fused.by_first.ptr<std::uint8_t>(y);
    for (int x = 0; x < slot.map.disparity.cols; ++x)
    {
      const bool filled = std::isnan(disparity[x]);
      const ViewPixel origin = filled             ? ViewPixel::Filled
                               : by_first[x] != 0 ? ViewPixel::Seen
                                                  : ViewPixel::Solved;
      slot.map.origin.ptr<std::uint8_t>(y)[x] = static_cast<std::uint8_t>(origin);
      if (filled)
      {
        slot.map.confidence.ptr<float>(y)[x] = 0.0F;
      }
    }
  }
  fill(view, lowest, slot.map.disparity);
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
  const cloud::Tolerance tolerance = cloud::toleranceFor(light_field, cloud::rangeOf(maps));
  cv::minMaxIdx(maps.front().disparity, &lowest);
  std::vector<cloud::SurfaceMap> surfaces = cloud::makeSurfaceMaps(light_field, maps, tolerance, pool);
  const std::size_t views = light_field.views.size();
  std::vector<Slot> slots(std::min(views, static_cast<std::size_t>(pool.threads())));
  for (std::size_t first = 0; first < views; first += slots.size())
  {
    const std::size_t count = std::min(slots.size(), views - first);
    pool.parallelFor(0, static_cast<int>(count), 1,
                     [&](int begin, int end)
                     {
                       for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
                       {
                         const View& view = light_field.views[first + i];
                         Slot& slot = slots[i];
                         cloud::fuseView(surfaces, view, tolerance, options.min_confidence, slot.scratch,
                                         slot.fused);
                         slot.map.view_index = first + i;
                         makeMap(view, static_cast<float>(lowest), slot);
                       }
                     });
    for (std::size_t i = 0; i < count; ++i)
    {
      sink(slots[i].map);
    }
  }
}

}  // namespace light_field_depth
