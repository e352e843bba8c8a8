#include "light_field_depth/core/multiview/view_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace light_field_depth::multiview
{
namespace
{
constexpr float NOTHING = -std::numeric_limits<float>::infinity();
/// A gap of at most this many pixels between two pixels of nearly the same disparity is no disocclusion.
constexpr int MAX_CRACK_PX = 2;
constexpr float MAX_CRACK_JUMP_PX = 0.5F;  // of displacement in the view

void scatter(const cv::Mat& disparity, const cv::Mat& confidence, const View& view, ViewDisparity& map)
{
  map.disparity.create(disparity.size(), CV_32FC1);
  map.disparity.setTo(NOTHING);
  map.confidence = cv::Mat::zeros(disparity.size(), CV_32FC1);
  const auto step_x = static_cast<float>(view.steps.x);
  const auto step_y = static_cast<float>(view.steps.y);
  for (int y = 0; y < disparity.rows; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    const auto* const trust = confidence.ptr<float>(y);
    const float base_x = static_cast<float>(view.offset_px.x) + 0.5F;
    const float base_y = static_cast<float>(view.offset_px.y) + static_cast<float>(y) + 0.5F;
    for (int x = 0; x < disparity.cols; ++x)
    {
      const auto to_x = static_cast<int>(std::floor(static_cast<float>(x) + base_x - row[x] * step_x));
      const auto to_y = static_cast<int>(std::floor(base_y - row[x] * step_y));
      if (to_x < 0 || to_x >= disparity.cols || to_y < 0 || to_y >= disparity.rows)
      {
        continue;
      }
      float& target = map.disparity.at<float>(to_y, to_x);
      if (row[x] > target)
      {
        target = row[x];
        map.confidence.at<float>(to_y, to_x) = trust[x];
      }
    }
  }
}

/// A row or a column of a map.
struct Line
{
  float* disparity = nullptr;
  float* confidence = nullptr;
  std::size_t stride = 1;
  int count = 0;

  float& disparityAt(int i) const { return disparity[static_cast<std::size_t>(i) * stride]; }
  float& confidenceAt(int i) const { return confidence[static_cast<std::size_t>(i) * stride]; }
};

void fillGap(const Line& line, int first, int last, float max_jump)
{
  const bool has_before = first > 0;
  const bool has_after = last < line.count;
  if (!has_before && !has_after)
  {
    return;
  }
  const float before = line.disparityAt(has_before ? first - 1 : last);
  const float after = line.disparityAt(has_after ? last : first - 1);
  const bool crack =
      has_before && has_after && last - first <= MAX_CRACK_PX && std::abs(before - after) <= max_jump;
  const float trust = crack ? std::min(line.confidenceAt(first - 1), line.confidenceAt(last)) : 0.0F;
  for (int i = first; i < last; ++i)
  {
    line.disparityAt(i) = crack ? 0.5F * (before + after) : std::min(before, after);
    line.confidenceAt(i) = trust;
  }
}

void fillLine(const Line& line, float max_jump)
{
  int i = 0;
  while (i < line.count)
  {
    int end = i;
    while (end < line.count && line.disparityAt(end) == NOTHING)
    {
      ++end;
    }
    if (end > i)
    {
      fillGap(line, i, end, max_jump);
    }
    i = end + 1;
  }
}

void fillAlongRows(ViewDisparity& map, float max_jump)
{
  for (int y = 0; y < map.disparity.rows; ++y)
  {
    fillLine({map.disparity.ptr<float>(y), map.confidence.ptr<float>(y), 1, map.disparity.cols}, max_jump);
  }
}

void fillAlongColumns(ViewDisparity& map, float max_jump)
{
  for (int x = 0; x < map.disparity.cols; ++x)
  {
    fillLine({map.disparity.ptr<float>() + x, map.confidence.ptr<float>() + x,
              static_cast<std::size_t>(map.disparity.cols), map.disparity.rows},
             max_jump);
  }
}

void fill(const View& view, ViewDisparity& map)
{
  const double motion = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
  const float max_jump = MAX_CRACK_JUMP_PX * static_cast<float>(MAX_CRACK_PX / std::max(motion, 1e-3));
  if (std::abs(view.steps.x) >= std::abs(view.steps.y))
  {
    fillAlongRows(map, max_jump);
    fillAlongColumns(map, max_jump);  // rows that nothing reached
  }
  else
  {
    fillAlongColumns(map, max_jump);
    fillAlongRows(map, max_jump);
  }
}

}  // namespace

std::vector<ViewDisparity> warpToViews(const LightField& light_field, const cv::Mat& disparity,
                                       const cv::Mat& confidence, ThreadPool& pool)
{
  std::vector<ViewDisparity> maps(light_field.views.size());
  const float lowest =
      static_cast<float>(*std::min_element(disparity.begin<float>(), disparity.end<float>()));
  pool.parallelFor(0, static_cast<int>(maps.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       const auto index = static_cast<std::size_t>(i);
                       maps[index].view_index = index;
                       scatter(disparity, confidence, light_field.views[index], maps[index]);
                       fill(light_field.views[index], maps[index]);
                       // A view that sees nothing of the reference's surfaces at all.
                       maps[index].disparity.setTo(lowest, maps[index].disparity == NOTHING);
                     }
                   });
  return maps;
}

}  // namespace light_field_depth::multiview
