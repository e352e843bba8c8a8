#include "core/cloud/surface_warp.h"

#include <algorithm>
#include <cmath>

namespace light_field_depth::cloud
{
namespace
{
/// Disparities that differ by less belong to one surface. Set by hand, the same as for the votes of the
/// fusion.
constexpr float SAME_SURFACE = 0.015F;

/// A line is finished when the rows that may reach it have been brought; one more for what is rounded.
constexpr float ROUNDING_ROWS = 1.0F;
/// Lines of the ring besides those between the least and the most rise: the one before the current one, the
/// one after it, and those of the rows that are brought for safety.
constexpr int SPARE_LINES = 10;

int powerOfTwoFrom(int least)
{
  int power = 1;
  while (power < least)
  {
    power *= 2;
  }
  return power;
}

}  // namespace

void SurfaceWarp::begin(const SurfaceMap& map, const View& view, const Tolerance& tolerance)
{
  map_ = &map;
  tolerance_ = &tolerance;
  const cv::Size size = map.moving.size();
  width_ = static_cast<std::size_t>(size.width);
  const cv::Point2f steps = view.steps - map.steps;
  const cv::Point2f offset = view.offset_px - map.offset_px;
  begin_y_ = offset.y + 0.5F;  // half a pixel more: the conversion to an integer then rounds
  const float near_rise = begin_y_ - map.range.max * steps.y;
  const float far_rise = begin_y_ - map.range.min * steps.y;
  least_rise_ = std::min(near_rise, far_rise);
  most_rise_ = std::max(near_rise, far_rise);
  const float height = static_cast<float>(size.height);
  const int lines = static_cast<int>(std::min(most_rise_ - least_rise_, height)) + SPARE_LINES;
  const int ring = powerOfTwoFrom(std::min(lines, size.height));
  source_.resize(static_cast<std::size_t>(ring) * width_);
  disparity_.resize(source_.size());
  target_.resize(width_);
  there_.resize(width_);
  projected_.width = size.width;
  projected_.height = size.height;
  projected_.row_mask = ring - 1;
  projected_.begin_x = offset.x + 0.5F;
  projected_.steps_x = steps.x;
  projected_.steps_y = steps.y;
  projected_.target = target_.data();
  projected_.there = there_.data();
  next_line_ = 0;
  next_row_ = 0;
  next_clear_ = 0;
}

WarpedRow SurfaceWarp::nextRow()
{
  const int line = next_line_++;
  finish(std::min(line + 1, projected_.height - 1));  // gaps are closed from both sides
  closeGaps(line);
  const std::size_t start = startOf(line);
  return {source_.data() + start, disparity_.data() + start};
}

/// Brings all rows that may reach a line.
void SurfaceWarp::finish(int line)
{
  const float first_beyond = static_cast<float>(line) + 1.0F - least_rise_ + ROUNDING_ROWS;
  while (next_row_ < projected_.height && static_cast<float>(next_row_) < first_beyond)
  {
    const float highest = static_cast<float>(next_row_) + most_rise_ + ROUNDING_ROWS;
    clearUpTo(static_cast<int>(std::clamp(highest, -1.0F, static_cast<float>(projected_.height - 1))));
    bring(next_row_++);
  }
  clearUpTo(line);
}

void SurfaceWarp::clearUpTo(int line)
{
  for (; next_clear_ <= line; ++next_clear_)
  {
    std::fill_n(source_.data() + startOf(next_clear_), width_, WarpedRow::NOTHING_HERE);
  }
}

void SurfaceWarp::bring(int row)
{
  projected_.disparity = map_->moving.ptr<float>(row);
  projected_.slope_x = map_->slope_x.ptr<float>(row);
  projected_.slope_y = map_->slope_y.ptr<float>(row);
  projected_.begin_y = static_cast<float>(row) + begin_y_;
  projectRow(projected_);
  const auto first = static_cast<std::int32_t>(row) * projected_.width;
  // Pointers of this function's own, which nothing that it writes may change.
  const std::int32_t* const target = target_.data();
  const float* const there = there_.data();
  std::int32_t* const source = source_.data();
  float* const disparity = disparity_.data();
  const int width = projected_.width;
  for (int x = 0; x < width; ++x)
  {
    const std::int32_t at = target[x];
    if (at >= 0 && (source[at] < 0 || isBetter(at, first + x, there[x])))
    {
      disparity[at] = there[x];
      source[at] = first + x;
    }
  }
}

/// Whether a pixel of the map is to take the place of the one that is there.
bool SurfaceWarp::isBetter(std::int32_t target, std::int32_t source, float there) const
{
  const auto at = static_cast<std::size_t>(target);
  const float ahead = there - disparity_[at];
  const float same = tolerance_->gap(there, SAME_SURFACE);
  return ahead > same || (ahead > -same && distanceOf(source) < distanceOf(source_[at]));
}

/// Squared, from where a pixel of the map falls to the middle of the pixel there.
float SurfaceWarp::distanceOf(std::int32_t source) const
{
  const std::int32_t row = source / projected_.width;
  const std::int32_t column = source % projected_.width;
  const float disparity = map_->moving.ptr<float>(row)[column];
  const float at_x = static_cast<float>(column) + projected_.begin_x - disparity * projected_.steps_x;
  const float at_y = static_cast<float>(row) + begin_y_ - disparity * projected_.steps_y;
  const float gap_x = std::trunc(at_x) + 0.5F - at_x;
  const float gap_y = std::trunc(at_y) + 0.5F - at_y;
  return gap_x * gap_x + gap_y * gap_y;
}

/// Closes gaps of one pixel between two pixels of one surface.
void SurfaceWarp::closeGaps(int line)
{
  constexpr std::size_t run = 16;
  const std::size_t start = startOf(line);
  const bool has_both_lines = line > 0 && line + 1 < projected_.height;
  const std::size_t above = has_both_lines ? startOf(line - 1) : 0;
  const std::size_t below = has_both_lines ? startOf(line + 1) : 0;
  for (std::size_t x = 0; x < width_;)
  {
    const std::int32_t* const here = source_.data() + start + x;
    if (x + run <= width_)
    {
      std::int32_t any_gap = 0;
      for (std::size_t i = 0; i < run; ++i)
      {
        any_gap |= here[i];
      }
      if (any_gap >= 0)
      {
        x += run;
        continue;
      }
    }
    for (const std::size_t end = std::min(x + run, width_); x < end; ++x)
    {
      if (source_[start + x] >= 0)
      {
        continue;
      }
      if (x > 0 && x + 1 < width_)
      {
        closeGap(start + x - 1, start + x, start + x + 1);
      }
      if (source_[start + x] < 0 && has_both_lines)
      {
        closeGap(above + x, start + x, below + x);
      }
    }
  }
}

void SurfaceWarp::closeGap(std::size_t before, std::size_t here, std::size_t after)
{
  if (source_[before] >= 0 && source_[after] >= 0 &&
      std::abs(disparity_[before] - disparity_[after]) <= tolerance_->gap(disparity_[before], SAME_SURFACE))
  {
    disparity_[here] = 0.5F * (disparity_[before] + disparity_[after]);
    source_[here] = source_[before];
  }
}

}  // namespace light_field_depth::cloud
