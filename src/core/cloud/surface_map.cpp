#include "core/cloud/surface_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::cloud
{
namespace
{
constexpr int ROWS_PER_CHUNK = 32;
/// What a disparity may be off, as displacement in the outermost view. Set by hand: about twice the error of
/// the multi-view method on what is textured.
constexpr double FLOOR_PX = 0.06;
/// Where nothing says what infinity is, the farthest disparity counts as twice as far as the nearest.
constexpr float UNKNOWN_DEPTH_RATIO = 2.0F;

/// A pixel at a rim: its window spans more than RIM_SPAN of depth, and it is more than RIM_GAP from both
/// ends. On the demo the share of points that fly falls from 0.9 to 0.2 % with it.
constexpr int RIM_WINDOW_PX = 5;
constexpr float RIM_SPAN = 0.03F;
constexpr float RIM_GAP = 0.015F;

/// Planes are fitted to so many pixels a side; less noise with more, rounder edges as well.
constexpr int PLANE_REACH_PX = 3;
/// A neighbour that differs by more than this part of depth for each pixel of distance lies on another
/// surface.
constexpr float PLANE_STEP = 0.01F;

/// Least squares over what lies on the pixel's own surface.
cv::Point2f slopeOfOwnSurface(const cv::Mat& disparity, const Tolerance& tolerance, int x, int y)
{
  const float centre = disparity.at<float>(y, x);
  const float step = tolerance.gap(centre, PLANE_STEP);
  float xx = 0.0F;
  float xy = 0.0F;
  float yy = 0.0F;
  float xd = 0.0F;
  float yd = 0.0F;
  for (int v = std::max(y - PLANE_REACH_PX, 0); v <= std::min(y + PLANE_REACH_PX, disparity.rows - 1); ++v)
  {
    const auto* const row = disparity.ptr<float>(v);
    for (int u = std::max(x - PLANE_REACH_PX, 0); u <= std::min(x + PLANE_REACH_PX, disparity.cols - 1); ++u)
    {
      const float rise = row[u] - centre;
      const auto dx = static_cast<float>(u - x);
      const auto dy = static_cast<float>(v - y);
      if (std::abs(rise) <= step * std::max(std::abs(dx), std::abs(dy)))
      {
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
        xd += dx * rise;
        yd += dy * rise;
      }
    }
  }
  const float determinant = xx * yy - xy * xy;
  return determinant > 1.0F
             ? cv::Point2f((yy * xd - xy * yd) / determinant, (xx * yd - xy * xd) / determinant)
             : cv::Point2f();
}

/// Slopes of least squares over whole windows, which hold one surface alone most of the time.
void fitWholeWindows(const cv::Mat& disparity, cv::Mat& slope_x, cv::Mat& slope_y)
{
  constexpr int side = 2 * PLANE_REACH_PX + 1;
  cv::Mat ramp(1, side, CV_32FC1);
  float squares = 0.0F;
  for (int i = -PLANE_REACH_PX; i <= PLANE_REACH_PX; ++i)
  {
    squares += static_cast<float>(i * i);
    ramp.at<float>(0, i + PLANE_REACH_PX) = static_cast<float>(i);
  }
  ramp /= squares;
  const cv::Mat mean(1, side, CV_32FC1, cv::Scalar(1.0 / side));
  cv::sepFilter2D(disparity, slope_x, CV_32F, ramp, mean, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  cv::sepFilter2D(disparity, slope_y, CV_32F, mean, ramp, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
}

/// Least and greatest value of the square about each pixel.
struct Extent
{
  Extent(const cv::Mat& values, int side)
  {
    const cv::Mat window = cv::Mat::ones(side, side, CV_8UC1);
    cv::erode(values, low, window);
    cv::dilate(values, high, window);
  }
  cv::Mat low;
  cv::Mat high;
};

/// What takes part, apart, and its range.
void separateMoving(SurfaceMap& surface)
{
  surface.moving = surface.disparity.clone();
  const cv::Mat still = surface.confidence < 0.0F;
  surface.moving.setTo(std::numeric_limits<float>::quiet_NaN(), still);
  double low = 0.0;
  double high = 0.0;
  const cv::Mat part = still == 0;
  if (cv::countNonZero(part) > 0)
  {
    cv::minMaxLoc(surface.disparity, &low, &high, nullptr, nullptr, part);
  }
  surface.range = {static_cast<float>(low), static_cast<float>(high)};
}

}  // namespace

Tolerance toleranceFor(const LightField& light_field, const DisparityRange& range)
{
  double widest = 1e-6;
  for (const View& view : light_field.views)
  {
    widest = std::max({widest, std::abs(view.steps.x), std::abs(view.steps.y)});
  }
  Tolerance tolerance;
  tolerance.floor_px = static_cast<float>(FLOOR_PX / widest);
  tolerance.offset_px = light_field.calibration
                            ? static_cast<float>(light_field.calibration->disparity_offset_px)
                            : (range.max - UNKNOWN_DEPTH_RATIO * range.min) / (UNKNOWN_DEPTH_RATIO - 1.0F);
  return tolerance;
}

cv::Mat unknownPixels(const cv::Mat& disparity)
{
  cv::Mat unknown;
  cv::compare(disparity, disparity, unknown, cv::CMP_NE);
  return unknown;
}

SurfaceMap makeSurfaceMap(const ViewDisparity& map, const View& view, const Tolerance& tolerance,
                          ThreadPool& pool)
{
  SurfaceMap surface;
  surface.steps = view.steps;
  surface.offset_px = view.offset_px;
  surface.disparity = map.disparity;
  surface.held = map.held;
  surface.confidence = map.confidence.empty() ? cv::Mat(map.disparity.size(), CV_32FC1, cv::Scalar(1.0))
                                              : map.confidence.clone();
  // What is no number takes no part, and must not spread through the windows.
  cv::Mat known = map.disparity;
  const cv::Mat unknown = unknownPixels(map.disparity);
  if (cv::countNonZero(unknown) > 0)
  {
    known = map.disparity.clone();
    known.setTo(-tolerance.offset_px, unknown);
    surface.disparity = known;
    surface.confidence.setTo(-1.0F, unknown);
  }
  fitWholeWindows(known, surface.slope_x, surface.slope_y);
  const Extent rim(known, RIM_WINDOW_PX);
  const Extent plane(known, 2 * PLANE_REACH_PX + 1);
  pool.parallelFor(0, known.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const disparity = known.ptr<float>(y);
                       auto* const confidence = surface.confidence.ptr<float>(y);
                       for (int x = 0; x < known.cols; ++x)
                       {
                         const float low = rim.low.ptr<float>(y)[x];
                         const float high = rim.high.ptr<float>(y)[x];
                         const float gap = tolerance.gap(disparity[x], RIM_GAP);
                         const bool hangs = high - low > tolerance.gap(disparity[x], RIM_SPAN) + gap &&
                                            disparity[x] - low > gap && high - disparity[x] > gap;
                         if (hangs || !(confidence[x] > 0.0F) || !(tolerance.absolute(disparity[x]) > 0.0F))
                         {
                           confidence[x] = -1.0F;
                         }
                         const float step = tolerance.gap(disparity[x], PLANE_STEP);
                         if (plane.high.ptr<float>(y)[x] - plane.low.ptr<float>(y)[x] > 2.0F * step)
                         {
                           const cv::Point2f slope = slopeOfOwnSurface(known, tolerance, x, y);
                           surface.slope_x.ptr<float>(y)[x] = slope.x;
                           surface.slope_y.ptr<float>(y)[x] = slope.y;
                         }
                       }
                     }
                   });
  separateMoving(surface);
  return surface;
}

std::vector<SurfaceMap> makeSurfaceMaps(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                        const Tolerance& tolerance, ThreadPool& pool)
{
  std::vector<SurfaceMap> surfaces;
  for (std::size_t i = 0; i < std::min(maps.size(), MAX_FUSED_MAPS); ++i)
  {
    surfaces.push_back(makeSurfaceMap(maps[i], light_field.views[maps[i].view_index], tolerance, pool));
  }
  return surfaces;
}

DisparityRange rangeOf(const std::vector<ViewDisparity>& maps)
{
  double low = 0.0;
  double high = 0.0;
  cv::minMaxIdx(maps.front().disparity, &low, &high);
  return {static_cast<float>(low), static_cast<float>(high)};
}

}  // namespace light_field_depth::cloud
