#include "core/light_field/view_set.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/pixel_kernels.h"
#include "core/light_field/view_mask.h"

namespace light_field_depth::multiview
{
namespace
{
/// Steps of 45 degrees: rows, columns and diagonals of a grid have one each.
constexpr int DIRECTIONS = 8;
/// Of each direction; the rest is left out, evenly.
constexpr int MAX_VIEWS_PER_ARM = 8;
/// Room for the taps of an interpolation and for vectors that run over the end of a row.
constexpr int SAMPLING_MARGIN_PX = 8;
/// How far the taps of an interpolation lie from the pixel that is nearest to it, and those of a derivative
/// from theirs.
constexpr int SAMPLE_RADIUS_PX = 2;
/// A cache line, and the widest vector.
constexpr std::size_t ROW_ALIGNMENT = 64;

int directionOf(const cv::Point2d& steps)
{
  const double eighths = std::atan2(steps.y, steps.x) / (CV_PI / 4.0);
  return (static_cast<int>(std::lround(eighths)) + DIRECTIONS) % DIRECTIONS;
}

/// Thins the views of one arm, nearest first, to a number, keeping the nearest and the farthest.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& views, int limit)
{
  if (static_cast<int>(views.size()) <= limit)
  {
    return views;
  }
  std::vector<std::size_t> kept;
  for (int i = 0; i < limit; ++i)
  {
    const double position = static_cast<double>(i) * static_cast<double>(views.size() - 1) / (limit - 1);
    kept.push_back(views[static_cast<std::size_t>(std::lround(position))]);
  }
  return kept;
}

std::vector<std::vector<std::size_t>> viewsByDirection(const LightField& light_field, int limit)
{
  std::vector<std::vector<std::size_t>> by_direction(DIRECTIONS);
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    if (i != light_field.reference_index && std::hypot(steps.x, steps.y) > 1e-6)
    {
      by_direction[static_cast<std::size_t>(directionOf(steps))].push_back(i);
    }
  }
  for (auto& views : by_direction)
  {
    const auto distance = [&](std::size_t i)
    { return std::hypot(light_field.views[i].steps.x, light_field.views[i].steps.y); };
    std::stable_sort(views.begin(), views.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    views = thinned(views, limit);
  }
  return by_direction;
}

/// Repeats the ends of a row of one channel.
void fillPads(const PlanarImage& planar, std::uint8_t* row)
{
  const int width = planar.width();
  const std::size_t right = planar.channelStride() - static_cast<std::size_t>(planar.pad() + width);
  std::memset(row - planar.pad(), row[0], static_cast<std::size_t>(planar.pad()));
  std::memset(row + width, row[width - 1], right);
}

/// The image in the channels and with the blur that are asked for.
cv::Mat preparedImage(const cv::Mat& image, const ViewSetSettings& settings)
{
  cv::Mat prepared = settings.grey ? toGrey(image) : image;
  if (settings.blur_sigma_px > 0.0)
  {
    cv::Mat blurred;
    cv::GaussianBlur(prepared, blurred, {}, settings.blur_sigma_px, settings.blur_sigma_px,
                     cv::BORDER_REPLICATE);
    prepared = blurred;
  }
  return prepared;
}

void toPlanar(const cv::Mat& image, int pad, PlanarImage& planar)
{
  planar.create(image.cols, image.rows, image.channels(), pad);
  const std::size_t stride = planar.channelStride();
  for (int y = 0; y < planar.height(); ++y)
  {
    const auto* const row = image.ptr<std::uint8_t>(y);
    std::uint8_t* const plane = planar.row(y);
    if (planar.channels() == 1)
    {
      std::copy_n(row, image.cols, plane);
    }
    else
    {
      splitPixels({row, image.cols, {plane, plane + stride, plane + 2 * stride}});
    }
    for (std::size_t channel = 0; channel < static_cast<std::size_t>(planar.channels()); ++channel)
    {
      fillPads(planar, plane + channel * stride);
    }
  }
}

void toPlanarMask(const cv::Mat& mask, int radius_px, int pad, PlanarImage& masked)
{
  if (!mask.empty())
  {
    toPlanar(maskedWithin(mask, radius_px), pad, masked);
  }
  else if (masked.width() > 0)
  {
    masked = PlanarImage();
  }
}

}  // namespace

void PlanarImage::create(int width, int height, int channels, int pad)
{
  width_ = width;
  height_ = height;
  channels_ = channels;
  pad_ = pad;
  const auto needed = static_cast<std::size_t>(width + 2 * pad) + ROW_ALIGNMENT;
  pitch_ = (needed + ROW_ALIGNMENT - 1) / ROW_ALIGNMENT * ROW_ALIGNMENT;
  values_.resize(pitch_ * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels) +
                 ROW_ALIGNMENT);
}

void prepareViews(const LightField& light_field, const ViewSetSettings& settings, ThreadPool& pool,
                  ViewSet& view_set)
{
  const auto by_direction = viewsByDirection(light_field, MAX_VIEWS_PER_ARM);
  std::vector<std::size_t> order;
  view_set.arms.clear();
  for (int direction = 0; direction < DIRECTIONS; ++direction)
  {
    const auto& views = by_direction[static_cast<std::size_t>(direction)];
    if (!views.empty())
    {
      const int first = static_cast<int>(order.size());
      view_set.arms.push_back({first, first + static_cast<int>(views.size()), direction});
      order.insert(order.end(), views.begin(), views.end());
    }
  }
  view_set.views.resize(order.size());
  const double widest_disparity = std::max(std::abs(settings.range.min), std::abs(settings.range.max));
  double motion = 0.0;
  for (const Arm& arm : view_set.arms)
  {
    for (int i = arm.first; i < arm.last; ++i)
    {
      PreparedView& prepared = view_set.views[static_cast<std::size_t>(i)];
      prepared.index = order[static_cast<std::size_t>(i)];
      const View& view = light_field.views[prepared.index];
      prepared.steps = view.steps;
      prepared.offset_px = view.offset_px;
      const double distance = std::hypot(view.steps.x, view.steps.y);
      prepared.position = static_cast<float>(arm.direction < DIRECTIONS / 2 ? distance : -distance);
      motion = std::max(motion, widest_disparity * std::abs(view.steps.x) + std::abs(view.offset_px.x));
    }
  }
  const double visible = visibleShift(motion, light_field.size().width);
  const int pad = static_cast<int>(std::ceil(visible)) + SAMPLING_MARGIN_PX;
  const auto prepare = [&](int i)
  {
    if (i < 0)
    {
      toPlanar(preparedImage(light_field.reference().image, settings), pad, view_set.reference);
      toPlanarMask(light_field.reference().mask, 0, pad, view_set.reference_masked);
      toPlanarMask(light_field.reference().mask, SAMPLE_RADIUS_PX, pad, view_set.reference_margin);
      return;
    }
    PreparedView& view = view_set.views[static_cast<std::size_t>(i)];
    const cv::Mat image = preparedImage(light_field.views[view.index].image, settings);
    toPlanar(image, pad, view.image);
    toPlanarMask(light_field.views[view.index].mask, SAMPLE_RADIUS_PX, pad, view.masked);
  };
  pool.parallelFor(-1, static_cast<int>(order.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       prepare(i);
                     }
                   });
}

LightField withThinnedArms(const LightField& light_field, int max_views_per_arm)
{
  std::vector<std::size_t> kept = {light_field.reference_index};
  for (const auto& arm : viewsByDirection(light_field, max_views_per_arm))
  {
    kept.insert(kept.end(), arm.begin(), arm.end());
  }
  std::sort(kept.begin(), kept.end());
  LightField thinned;
  thinned.calibration = light_field.calibration;
  for (const std::size_t index : kept)
  {
    if (index == light_field.reference_index)
    {
      thinned.reference_index = thinned.views.size();
    }
    thinned.views.push_back(light_field.views[index]);
  }
  return thinned;
}

void preparePlanar(const cv::Mat& image, const ViewSetSettings& settings, int pad, PlanarImage& planar)
{
  toPlanar(preparedImage(image, settings), pad, planar);
}

}  // namespace light_field_depth::multiview
