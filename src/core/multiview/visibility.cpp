#include "light_field_depth/core/multiview/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace light_field_depth::multiview
{
namespace
{
constexpr std::size_t ROW_ALIGNMENT = 64;
constexpr int ROWS_PER_CHUNK = 64;

/// Closing with three taps `stride` apart: fills single gaps between samples that a slanted surface leaves.
void closeLine(std::uint8_t* first, std::size_t stride, int count, std::vector<std::uint8_t>& scratch)
{
  scratch.resize(static_cast<std::size_t>(count) + 2);
  std::uint8_t before = first[0];
  for (int i = 0; i < count; ++i)
  {
    const std::uint8_t here = first[static_cast<std::size_t>(i) * stride];
    const std::uint8_t after = i + 1 < count ? first[static_cast<std::size_t>(i + 1) * stride] : here;
    scratch[static_cast<std::size_t>(i) + 1] = std::max({before, here, after});
    before = here;
  }
  scratch.front() = scratch[1];
  scratch.back() = scratch[static_cast<std::size_t>(count)];
  for (int i = 0; i < count; ++i)
  {
    const auto k = static_cast<std::size_t>(i);
    first[k * stride] = std::min({scratch[k], scratch[k + 1], scratch[k + 2]});
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
                       warpInto(disparity, view, labels, surface);
                       closeGaps(view, surface);
                     }
                   });
}

void VisibleSurfaces::warpInto(const cv::Mat& disparity, const PreparedView& view, const LabelSpace& labels,
                               std::uint8_t* surface) const
{
  const auto step_x = static_cast<float>(view.steps.x);
  const auto step_y = static_cast<float>(view.steps.y);
  const float per_label = 1.0F / labels.step_px;
  const float bias = VISIBILITY_BIAS - labels.first_px * per_label;
  for (int y = 0; y < height_; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    const float base_x = static_cast<float>(view.offset_px.x) + 0.5F;
    const float base_y = static_cast<float>(view.offset_px.y) + static_cast<float>(y) + 0.5F;
    for (int x = 0; x < width_; ++x)
    {
      const float d = row[x];
      const auto target_x = static_cast<int>(std::floor(static_cast<float>(x) + base_x - d * step_x));
      const auto target_y = static_cast<int>(std::floor(base_y - d * step_y));
      if (target_x >= 0 && target_x < width_ && target_y >= 0 && target_y < height_)
      {
        const float value = std::clamp(d * per_label + bias, 1.0F, 254.0F);
        std::uint8_t& target =
            surface[static_cast<std::size_t>(target_y) * pitch_ + static_cast<std::size_t>(target_x + pad_)];
        target = std::max(target, static_cast<std::uint8_t>(value));
      }
    }
  }
}

void VisibleSurfaces::closeGaps(const PreparedView& view, std::uint8_t* surface) const
{
  std::vector<std::uint8_t> scratch;
  if (std::abs(view.steps.x) >= std::abs(view.steps.y))
  {
    for (int y = 0; y < height_; ++y)
    {
      closeLine(surface + static_cast<std::size_t>(y) * pitch_ + pad_, 1, width_, scratch);
    }
  }
  if (std::abs(view.steps.y) >= std::abs(view.steps.x))
  {
    for (int x = 0; x < width_; ++x)
    {
      closeLine(surface + pad_ + x, pitch_, height_, scratch);
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
