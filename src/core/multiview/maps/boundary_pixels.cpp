#include "core/multiview/maps/boundary_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/multiview/maps/window_extent_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Of the window about an edge: mixed pixels reach one pixel to both sides, and one more shows a pure colour.
constexpr int RADIUS = 2;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;
constexpr float MIN_JUMP_PX = 0.2F;            // of the disparity in 3 x 3 pixels, to be an edge
constexpr float MIN_FOREGROUND_SHARE = 0.32F;  // pixels with less of the nearer surface go to the farther one
/// Weight of pixels that stand at the edge themselves: their colours are mixed.
constexpr float EDGE_WEIGHT = 0.02F;

using Colour = std::array<float, 3>;

Colour colourAt(const PlanarImage& image, int x, int y)
{
  Colour colour{};
  const std::uint8_t* const row = image.row(y) + x;
  for (std::size_t c = 0; c < colour.size(); ++c)
  {
    const std::size_t channel = image.channels() == 1 ? 0 : c;
    colour[c] = static_cast<float>(row[channel * image.channelStride()]);
  }
  return colour;
}

/// Weighted colour statistics of one side of an edge.
struct Side
{
  float weight = 0.0F;
  Colour sum{};
  Colour squares{};
  float disparity_weight = 0.0F;
  float disparity_sum = 0.0F;

  void add(const Colour& colour, float colour_weight, float disparity, float distance_weight)
  {
    weight += colour_weight;
    for (std::size_t c = 0; c < colour.size(); ++c)
    {
      sum[c] += colour_weight * colour[c];
      squares[c] += colour_weight * colour[c] * colour[c];
    }
    disparity_weight += distance_weight;
    disparity_sum += distance_weight * disparity;
  }
  Colour mean() const { return {sum[0] / weight, sum[1] / weight, sum[2] / weight}; }
  float disparity() const { return disparity_sum / disparity_weight; }
  /// Standard deviation, summed over the channels.
  float spread() const
  {
    const Colour centre = mean();
    float total = 0.0F;
    for (std::size_t c = 0; c < centre.size(); ++c)
    {
      total += std::sqrt(std::max(0.0F, squares[c] / weight - centre[c] * centre[c]));
    }
    return total;
  }
};

/// Least and largest disparity in the 3 x 3 pixels about those of some rows.
class Extents
{
public:
  Extents(const cv::Mat& disparity, int first_row, int end_row)
      : first_row_(first_row), low_(end_row - first_row, disparity.cols, CV_32FC1),
        high_(low_.size(), CV_32FC1)
  {
    std::vector<float> columns(extentScratch(disparity.cols));
    for (int y = first_row; y < end_row; ++y)
    {
      ExtentRow row = extentRowOf(disparity, y, 1);
      row.columns = columns.data();
      row.low = low_.ptr<float>(y - first_row);
      row.high = high_.ptr<float>(y - first_row);
      findExtents(row);
    }
  }

  float low(int x, int y) const { return low_.at<float>(y - first_row_, x); }
  float high(int x, int y) const { return high_.at<float>(y - first_row_, x); }

private:
  int first_row_;
  cv::Mat low_;
  cv::Mat high_;
};

class BoundaryPixelDecision
{
public:
  /// @param extents of the rows that are decided and RADIUS rows about them
  BoundaryPixelDecision(const PlanarImage& image, const cv::Mat& disparity, const Extents& extents,
                        const BoundaryPixelSettings& settings)
      : image_(image), disparity_(disparity), extents_(extents), settings_(settings)
  {
  }

  /// The disparity that pixel (x, y) should have, at least RADIUS + 1 pixels inside the image.
  float decide(int x, int y) const
  {
    const float low = extents_.low(x, y);
    const float high = extents_.high(x, y);
    const float here = disparity_.at<float>(y, x);
    const float middle = 0.5F * (low + high);
    if (high - low < MIN_JUMP_PX || here <= middle)
    {
      return here;
    }
    Side near;
    Side far;
    collect(x, y, middle, near, far);
    return isBackground(colourAt(image_, x, y), near, far) ? far.disparity() : here;
  }

private:
  bool touchesOtherSide(int x, int y, float middle) const
  {
    return extents_.low(x, y) <= middle && extents_.high(x, y) > middle;
  }

  void collect(int x, int y, float middle, Side& near, Side& far) const
  {
    for (int dy = -RADIUS; dy <= RADIUS; ++dy)
    {
      for (int dx = -RADIUS; dx <= RADIUS; ++dx)
      {
        if (dx == 0 && dy == 0)
        {
          continue;
        }
        const float disparity = disparity_.at<float>(y + dy, x + dx);
        const float distance_weight = 1.0F / static_cast<float>(dx * dx + dy * dy);
        const float colour_weight =
            distance_weight * (touchesOtherSide(x + dx, y + dy, middle) ? EDGE_WEIGHT : 1.0F);
        Side& side = disparity > middle ? near : far;
        side.add(colourAt(image_, x + dx, y + dy), colour_weight, disparity, distance_weight);
      }
    }
  }

  bool isBackground(const Colour& colour, const Side& near, const Side& far) const
  {
    if (near.weight <= 0.0F || far.weight <= 0.0F)
    {
      return false;
    }
    const Colour foreground = near.mean();
    const Colour background = far.mean();
    float contrast = 0.0F;
    float along = 0.0F;
    float norm = 0.0F;
    for (std::size_t c = 0; c < colour.size(); ++c)
    {
      const float difference = foreground[c] - background[c];
      contrast += std::abs(difference);
      along += (colour[c] - background[c]) * difference;
      norm += difference * difference;
    }
    if (contrast < settings_.min_contrast)
    {
      return false;
    }
    const float share = along / norm;
    float residual = 0.0F;
    for (std::size_t c = 0; c < colour.size(); ++c)
    {
      residual += std::abs(colour[c] - background[c] - share * (foreground[c] - background[c]));
    }
    return near.spread() + residual <= settings_.max_relative_spread * contrast &&
           share < MIN_FOREGROUND_SHARE;
  }

  const PlanarImage& image_;
  const cv::Mat& disparity_;
  const Extents& extents_;
  const BoundaryPixelSettings& settings_;
};

}  // namespace

void decideBoundaryPixels(const PlanarImage& image, const BoundaryPixelSettings& settings, ThreadPool& pool,
                          cv::Mat& disparity, cv::Mat& scratch)
{
  constexpr int margin = RADIUS + 1;
  disparity.copyTo(scratch);
  pool.parallelFor(margin, disparity.rows - margin, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     const Extents extents(scratch, first - RADIUS, last + RADIUS);
                     const BoundaryPixelDecision decision(image, scratch, extents, settings);
                     for (int y = first; y < last; ++y)
                     {
                       auto* const row = disparity.ptr<float>(y);
                       for (int x = margin; x < disparity.cols - margin; ++x)
                       {
                         row[x] = decision.decide(x, y);
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
