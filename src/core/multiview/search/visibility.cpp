#include "core/multiview/search/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/multiview/search/visibility_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// A cache line, and the widest vector.
constexpr std::size_t ROW_ALIGNMENT = 64;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;

void largestOfThree(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, int count,
                    std::uint8_t* result)
{
  for (int i = 0; i < count; ++i)
  {
    result[i] = std::max(std::max(a[i], b[i]), c[i]);
  }
}

void smallestOfThree(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, int count,
                     std::uint8_t* result)
{
  for (int i = 0; i < count; ++i)
  {
    result[i] = std::min(std::min(a[i], b[i]), c[i]);
  }
}

/// Closing with three taps along the rows: fills single gaps that a slanted surface leaves.
void closeRows(std::uint8_t* surface, std::size_t pitch, int width, int height)
{
  std::vector<std::uint8_t> line(static_cast<std::size_t>(width) + 2);
  std::vector<std::uint8_t> largest(line.size());
  for (int y = 0; y < height; ++y, surface += pitch)
  {
    std::copy_n(surface, width, line.data() + 1);
    line.front() = line[1];
    line.back() = line[line.size() - 2];
    largestOfThree(line.data(), line.data() + 1, line.data() + 2, width, largest.data() + 1);
    largest.front() = largest[1];
    largest.back() = largest[largest.size() - 2];
    smallestOfThree(largest.data(), largest.data() + 1, largest.data() + 2, width, surface);
  }
}

/// The same along the columns.
void closeColumns(std::uint8_t* surface, std::size_t pitch, int width, int height)
{
  constexpr int taps = 3;
  const auto stride = static_cast<std::size_t>(width);
  std::vector<std::uint8_t> largest(taps * stride);  // ring of rows
  const auto source = [&](int y)
  { return surface + static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * pitch; };
  const auto largest_at = [&](int y)
  { return largest.data() + static_cast<std::size_t>(std::clamp(y, 0, height - 1) % taps) * stride; };
  for (int y = 0; y <= height; ++y)
  {
    if (y < height)
    {
      largestOfThree(source(y - 1), source(y), source(y + 1), width, largest_at(y));
    }
    if (y > 0)
    {
      // No later row needs the one before this any more, so that it may take its result.
      smallestOfThree(largest_at(y - 2), largest_at(y - 1), largest_at(y), width, source(y - 1));
    }
  }
}

}  // namespace

void VisibleSurfaces::warp(const cv::Mat& disparity, const ViewSet& views, const LabelSpace& labels,
                           ThreadPool& pool)
{
  width_ = views.width();
  height_ = views.height();
  pad_ = views.reference.pad();
  const auto needed = static_cast<std::size_t>(width_ + 2 * pad_) + ROW_ALIGNMENT;
  pitch_ = (needed + ROW_ALIGNMENT - 1) / ROW_ALIGNMENT * ROW_ALIGNMENT;
  view_stride_ = pitch_ * static_cast<std::size_t>(height_);
  values_.resize(view_stride_ * views.views.size());
  outside_.assign(pitch_, OUT_OF_FRAME);
  quantize(disparity, labels, pool);
  pool.parallelFor(0, static_cast<int>(views.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       const PreparedView& view = views.views[static_cast<std::size_t>(i)];
                       std::uint8_t* const surface =
                           values_.data() + static_cast<std::size_t>(i) * view_stride_;
                       std::memset(surface, OUT_OF_FRAME, view_stride_);
                       for (int y = 0; y < height_; ++y)
                       {
                         std::memset(surface + static_cast<std::size_t>(y) * pitch_ + pad_, NO_SURFACE,
                                     static_cast<std::size_t>(width_));
                       }
                       warpInto(disparity, view, surface);
                       closeGaps(view, surface);
                       hideMasked(view, surface);
                     }
                   });
}

void VisibleSurfaces::quantize(const cv::Mat& disparity, const LabelSpace& labels, ThreadPool& pool)
{
  const float per_label = 1.0F / labels.step_px;
  const float bias = VISIBILITY_BIAS - labels.first_px * per_label;
  const auto width = static_cast<std::size_t>(width_);
  quantized_.resize(width * static_cast<std::size_t>(height_));
  pool.parallelFor(0, height_, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const row = disparity.ptr<float>(y);
                       std::uint8_t* const values = quantized_.data() + static_cast<std::size_t>(y) * width;
                       for (int x = 0; x < width_; ++x)
                       {
                         const float value = std::min(std::max(row[x] * per_label + bias, 1.0F), 254.0F);
                         values[x] = static_cast<std::uint8_t>(static_cast<int>(value));
                       }
                     }
                   });
}

void VisibleSurfaces::warpInto(const cv::Mat& disparity, const PreparedView& view,
                               std::uint8_t* surface) const
{
  WarpRow row;
  row.width = width_;
  row.height = height_;
  row.step_x = static_cast<float>(view.steps.x);
  row.step_y = static_cast<float>(view.steps.y);
  row.base_x = static_cast<float>(view.offset_px.x) + 0.5F;
  row.pitch = static_cast<int>(pitch_);
  row.first = pad_;
  const auto width = static_cast<std::size_t>(width_);
  std::vector<std::int32_t> targets(width);
  for (int y = 0; y < height_; ++y)
  {
    row.disparity = disparity.ptr<float>(y);
    row.base_y = static_cast<float>(view.offset_px.y) + static_cast<float>(y) + 0.5F;
    warpTargets(row, targets.data());
    const std::uint8_t* const values = quantized_.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x)
    {
      // What the view does not see goes to the first byte, which is out of the frame and stays so.
      std::uint8_t& seen = surface[targets[x]];
      seen = std::max(seen, values[x]);
    }
  }
}

void VisibleSurfaces::closeGaps(const PreparedView& view, std::uint8_t* surface) const
{
  if (std::abs(view.steps.x) >= std::abs(view.steps.y))
  {
    closeRows(surface + pad_, pitch_, width_, height_);
  }
  if (std::abs(view.steps.y) >= std::abs(view.steps.x))
  {
    closeColumns(surface + pad_, pitch_, width_, height_);
  }
}

void VisibleSurfaces::hideMasked(const PreparedView& view, std::uint8_t* surface) const
{
  if (view.masked.width() == 0)
  {
    return;
  }
  for (int y = 0; y < height_; ++y)
  {
    const std::uint8_t* const masked = view.masked.row(y);
    std::uint8_t* const row = surface + static_cast<std::size_t>(y) * pitch_ + pad_;
    for (int x = 0; x < width_; ++x)
    {
      row[x] = masked[x] != 0 ? OUT_OF_FRAME : row[x];
    }
  }
}

const std::uint8_t* VisibleSurfaces::row(int view, int y) const
{
  if (y < 0 || y >= height_)
  {
    return outside_.data() + pad_;
  }
  return values_.data() + static_cast<std::size_t>(view) * view_stride_ +
         static_cast<std::size_t>(y) * pitch_ + pad_;
}

}  // namespace light_field_depth::multiview
