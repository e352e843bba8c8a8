#include "core/multiview/maps/view_maps.h"

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

/// Like cv::Mat::create(), but never gives memory that another matrix header sees.
void createUnshared(const cv::Size& size, cv::Mat& values)
{
  if (values.u == nullptr || values.u->refcount > 1)
  {
    values.release();
  }
  values.create(size, CV_32FC1);
}

void scatter(const cv::Mat& disparity, const cv::Mat& confidence, const View& view, ViewDisparity& map)
{
  createUnshared(disparity.size(), map.disparity);
  map.disparity.setTo(NOTHING);
  createUnshared(disparity.size(), map.confidence);
  map.confidence.setTo(0.0F);
  const auto step_x = static_cast<float>(view.steps.x);
  const auto step_y = static_cast<float>(view.steps.y);
  const auto columns = static_cast<float>(disparity.cols);
  const auto rows = static_cast<float>(disparity.rows);
  for (int y = 0; y < disparity.rows; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    const auto* const trust = confidence.ptr<float>(y);
    const float base_x = static_cast<float>(view.offset_px.x) + 0.5F;
    const float base_y = static_cast<float>(view.offset_px.y) + static_cast<float>(y) + 0.5F;
    for (int x = 0; x < disparity.cols; ++x)
    {
      const float to_x = static_cast<float>(x) + base_x - row[x] * step_x;
      const float to_y = base_y - row[x] * step_y;
      // Compared as floats: the conversion below is then the floor, without a call of it.
      if (!(to_x >= 0.0F && to_x < columns && to_y >= 0.0F && to_y < rows))
      {
        continue;
      }
      const int target_y = static_cast<int>(to_y);
      const int target_x = static_cast<int>(to_x);
      float& target = map.disparity.ptr<float>(target_y)[target_x];
      if (row[x] > target)
      {
        target = row[x];
        map.confidence.ptr<float>(target_y)[target_x] = trust[x];
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

/// All columns side by side, row after row, because a column alone touches a cache line for each pixel.
void fillAlongColumns(ViewDisparity& map, float max_jump)
{
  const int rows = map.disparity.rows;
  const auto column = [&map, rows](int x)
  {
    return Line{map.disparity.ptr<float>() + x, map.confidence.ptr<float>() + x,
                static_cast<std::size_t>(map.disparity.cols), rows};
  };
  std::vector<int> gap_begin(static_cast<std::size_t>(map.disparity.cols), 0);
  for (int y = 0; y < rows; ++y)
  {
    const auto* const row = map.disparity.ptr<float>(y);
    for (int x = 0; x < map.disparity.cols; ++x)
    {
      int& begin = gap_begin[static_cast<std::size_t>(x)];
      if (row[x] == NOTHING)
      {
        continue;
      }
      if (begin < y)
      {
        fillGap(column(x), begin, y, max_jump);
      }
      begin = y + 1;
    }
  }
  for (int x = 0; x < map.disparity.cols; ++x)
  {
    const int begin = gap_begin[static_cast<std::size_t>(x)];
    if (begin < rows)
    {
      fillGap(column(x), begin, rows, max_jump);
    }
  }
}

/// Whether a fill along rows found a row without any pixel; it leaves such a row as it was.
bool hasEmptyRow(const ViewDisparity& map)
{
  for (int y = 0; y < map.disparity.rows; ++y)
  {
    if (map.disparity.at<float>(y, 0) == NOTHING)
    {
      return true;
    }
  }
  return false;
}

bool hasEmptyColumn(const ViewDisparity& map)
{
  const auto* const row = map.disparity.ptr<float>();
  return std::find(row, row + map.disparity.cols, NOTHING) != row + map.disparity.cols;
}

void fill(const View& view, ViewDisparity& map)
{
  const double motion = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
  const float max_jump = MAX_CRACK_JUMP_PX * static_cast<float>(MAX_CRACK_PX / std::max(motion, 1e-3));
  if (std::abs(view.steps.x) >= std::abs(view.steps.y))
  {
    fillAlongRows(map, max_jump);
    if (hasEmptyRow(map))
    {
      fillAlongColumns(map, max_jump);
    }
  }
  else
  {
    fillAlongColumns(map, max_jump);
    if (hasEmptyColumn(map))
    {
      fillAlongRows(map, max_jump);
    }
  }
}

float lowestOf(const cv::Mat& disparity)
{
  double lowest = 0.0;
  cv::minMaxIdx(disparity, &lowest);
  return static_cast<float>(lowest);
}

}  // namespace

void warpToViews(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                 ThreadPool& pool, std::vector<ViewDisparity>& maps)
{
  maps.resize(light_field.views.size());
  pool.parallelFor(0, static_cast<int>(maps.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       const auto index = static_cast<std::size_t>(i);
                       maps[index].view_index = index;
                       scatter(disparity, confidence, light_field.views[index], maps[index]);
                       fill(light_field.views[index], maps[index]);
                       if (maps[index].disparity.at<float>(0, 0) == NOTHING)
                       {
                         // The view sees nothing of the reference's surfaces at all.
                         maps[index].disparity.setTo(lowestOf(disparity));
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
