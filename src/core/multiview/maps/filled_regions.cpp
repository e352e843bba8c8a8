#include "core/multiview/maps/filled_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/multiview/maps/disparity_plane.h"
#include "core/multiview/refine/cell_sums.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr std::uint8_t FILLED = 255;
/// Planes through three known pixels that are tried for a region; where 60 % lie on one, all miss it once in
/// 10^7 times.
constexpr int TRIALS = 64;
/// A plane through fewer known pixels says little.
constexpr std::size_t MIN_KNOWN = 32;
/// More known pixels than this are thinned out.
constexpr std::size_t MAX_KNOWN = 512;
constexpr int RANDOM_SEED = 17;
/// How far outside of a region its plane has to go on.
constexpr int BEYOND_PX = 2 * CELL_PX;

/// A known pixel that touches a region, and one beyond it as seen from the region: x, y and disparity.
struct KnownPixel
{
  cv::Vec3d beside;
  cv::Vec3d beyond;
};

/// How well a plane fits what is known around a region.
struct Fit
{
  std::size_t on_plane = 0;
  std::size_t continued = 0;  ///< of these, with the pixel beyond on the plane, too

  std::size_t score() const { return on_plane + continued; }
};

/// A connected region of filled cells and what is along its outline.
struct Region
{
  std::vector<cv::Point> cells;
  std::vector<KnownPixel> known;
  std::size_t border_px = 0;  ///< of the outline, at the border of the image
};

/// Finds regions one after the other.
class RegionFinder
{
public:
  RegionFinder(const cv::Mat& share, const cv::Mat& disparity, float below_share)
      : disparity_(disparity), filled_(share < below_share), waiting_(filled_.clone())
  {
  }

  /// The pixels of a cell, as far as they are in the image.
  cv::Rect pixelsOf(const cv::Point& cell) const
  {
    return cv::Rect(cell.x * CELL_PX, cell.y * CELL_PX, CELL_PX, CELL_PX) & cv::Rect({}, disparity_.size());
  }

  std::optional<Region> next()
  {
    for (; scanned_.y < waiting_.rows; ++scanned_.y, scanned_.x = 0)
    {
      for (; scanned_.x < waiting_.cols; ++scanned_.x)
      {
        if (waiting_.at<std::uint8_t>(scanned_) != 0)
        {
          return regionFrom(scanned_);
        }
      }
    }
    return std::nullopt;
  }

private:
  Region regionFrom(const cv::Point& first)
  {
    Region region;
    region.cells.push_back(first);
    waiting_.at<std::uint8_t>(first) = 0;
    const cv::Rect all({}, filled_.size());
    for (std::size_t i = 0; i < region.cells.size(); ++i)
    {
      const cv::Point cell = region.cells[i];
      for (const cv::Point& side : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)})
      {
        const cv::Point neighbour = cell + side;
        if (!all.contains(neighbour))
        {
          region.border_px += CELL_PX;
        }
        else if (filled_.at<std::uint8_t>(neighbour) == 0)
        {
          addKnown(neighbour, side, region);
        }
        else if (waiting_.at<std::uint8_t>(neighbour) != 0)
        {
          waiting_.at<std::uint8_t>(neighbour) = 0;
          region.cells.push_back(neighbour);
        }
      }
    }
    return region;
  }

  /// The pixels of a known cell that touch the region. @param side the direction from the region to the cell
  void addKnown(const cv::Point& cell, const cv::Point& side, Region& region) const
  {
    const cv::Rect pixels = pixelsOf(cell);
    cv::Rect edge = pixels;
    if (side.x != 0)
    {
      edge.x = side.x > 0 ? pixels.x : pixels.x + pixels.width - 1;
      edge.width = std::min(pixels.width, 1);
    }
    else
    {
      edge.y = side.y > 0 ? pixels.y : pixels.y + pixels.height - 1;
      edge.height = std::min(pixels.height, 1);
    }
    for (int y = edge.y; y < edge.y + edge.height; ++y)
    {
      for (int x = edge.x; x < edge.x + edge.width; ++x)
      {
        const cv::Point beyond(std::clamp(x + side.x * BEYOND_PX, 0, disparity_.cols - 1),
                               std::clamp(y + side.y * BEYOND_PX, 0, disparity_.rows - 1));
        region.known.push_back({pixelAt({x, y}), pixelAt(beyond)});
      }
    }
  }

  cv::Vec3d pixelAt(const cv::Point& at) const
  {
    return {static_cast<double>(at.x), static_cast<double>(at.y), disparity_.at<float>(at)};
  }

  const cv::Mat& disparity_;
  cv::Mat filled_;   ///< of cells
  cv::Mat waiting_;  ///< filled cells that are in no region yet
  cv::Point scanned_;
};

Fit fitOf(const std::vector<KnownPixel>& known, const DisparityPlane& plane, double tolerance)
{
  Fit fit;
  for (const KnownPixel& pixel : known)
  {
    const bool on_plane = isOn(plane, pixel.beside, tolerance);
    fit.on_plane += on_plane ? 1 : 0;
    fit.continued += on_plane && isOn(plane, pixel.beyond, tolerance) ? 1 : 0;
  }
  return fit;
}

std::vector<KnownPixel> thinnedOut(const std::vector<KnownPixel>& known)
{
  const std::size_t step = known.size() / MAX_KNOWN + 1;
  std::vector<KnownPixel> kept;
  for (std::size_t i = 0; i < known.size(); i += step)
  {
    kept.push_back(known[i]);
  }
  return kept;
}

/// Least squares through what lies on a plane.
DisparityPlane refined(const std::vector<KnownPixel>& known, const DisparityPlane& plane, double tolerance)
{
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right;
  for (const KnownPixel& pixel : known)
  {
    if (isOn(plane, pixel.beside, tolerance))
    {
      const cv::Vec3d place(pixel.beside[0], pixel.beside[1], 1.0);
      normal += place * place.t();
      right += place * pixel.beside[2];
    }
  }
  bool solved = false;
  const cv::Matx33d inverse = normal.inv(cv::DECOMP_CHOLESKY, &solved);
  return solved ? DisparityPlane{inverse * right} : plane;
}

/// The plane that most of what is known around a region lies on.
std::optional<DisparityPlane> planeAround(const Region& region, const FilledRegionSettings& settings)
{
  const auto outline = static_cast<double>(region.border_px + region.known.size());
  if (region.known.size() < MIN_KNOWN ||
      static_cast<double>(region.border_px) > settings.max_border * outline)
  {
    return std::nullopt;
  }
  const std::vector<KnownPixel> known = thinnedOut(region.known);
  cv::RNG random(RANDOM_SEED);
  const auto any = [&]() -> const cv::Vec3d&
  { return known[static_cast<std::size_t>(random.uniform(0, static_cast<int>(known.size())))].beside; };
  std::optional<DisparityPlane> best;
  Fit best_fit;
  for (int trial = 0; trial < TRIALS; ++trial)
  {
    const auto plane = planeThrough({any(), any(), any()});
    const Fit fit = plane ? fitOf(known, *plane, settings.tolerance_px) : Fit();
    if (fit.score() > best_fit.score())
    {
      best_fit = fit;
      best = plane;
    }
  }
  const auto all = static_cast<double>(known.size());
  if (!best || static_cast<double>(best_fit.on_plane) < settings.min_planar * all ||
      static_cast<double>(best_fit.continued) < settings.min_continued * all)
  {
    return std::nullopt;
  }
  return refined(known, *best, settings.tolerance_px);
}

}  // namespace

cv::Mat findUnmeasured(const cv::Mat& share, const cv::Size& size, const FilledRegionSettings& settings)
{
  cv::Mat pixels;
  cv::resize(share < settings.below_share, pixels, share.size() * CELL_PX, 0.0, 0.0, cv::INTER_NEAREST);
  return pixels(cv::Rect({}, size)).clone();
}

cv::Mat findFilled(const cv::Mat& share, const cv::Mat& disparity, const FilledRegionSettings& settings)
{
  cv::Mat filled = cv::Mat::zeros(disparity.size(), CV_8UC1);
  RegionFinder finder(share, disparity, settings.below_share);
  while (const std::optional<Region> region = finder.next())
  {
    const std::optional<DisparityPlane> plane = planeAround(*region, settings);
    for (const cv::Point& cell : region->cells)
    {
      const cv::Rect pixels = finder.pixelsOf(cell);
      for (int y = pixels.y; y < pixels.y + pixels.height; ++y)
      {
        for (int x = pixels.x; x < pixels.x + pixels.width; ++x)
        {
          const cv::Vec3d pixel(x, y, disparity.at<float>(y, x));
          const bool held = plane && isOn(*plane, pixel, settings.tolerance_px);
          filled.at<std::uint8_t>(y, x) = held ? 0 : FILLED;
        }
      }
    }
  }
  return filled;
}

}  // namespace light_field_depth::multiview
