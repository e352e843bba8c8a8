#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/paper2017/patch_match.h"

namespace light_field_depth
{
namespace
{
/// Two seeds whose displacements differ by more than this belong to different regions.
constexpr double REGION_STEP_PX = 1.0;

/// Seeds connected to one another by displacements that change little.
class RegionSearch
{
public:
  RegionSearch(const cv::Mat& disparity, double pair_steps)
      : disparity_(disparity), pair_steps_(pair_steps), visited_(cv::Mat::zeros(disparity.size(), CV_8UC1))
  {
  }

  bool visited(const cv::Point& seed) const { return visited_.at<std::uint8_t>(seed) != 0; }

  /// All seeds of the region of a seed that no region had so far.
  const std::vector<cv::Point>& regionOf(const cv::Point& seed)
  {
    region_.clear();
    visit(seed);
    for (std::size_t next = 0; next < region_.size(); ++next)
    {
      const cv::Point from = region_[next];
      for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)})
      {
        if (connected(from, from + step))
        {
          visit(from + step);
        }
      }
    }
    return region_;
  }

private:
  void visit(const cv::Point& seed)
  {
    visited_.at<std::uint8_t>(seed) = 1;
    region_.push_back(seed);
  }

  bool connected(const cv::Point& from, const cv::Point& to) const
  {
    return cv::Rect(cv::Point(), disparity_.size()).contains(to) && !visited(to) &&
           std::abs(disparity_.at<float>(from) - disparity_.at<float>(to)) * pair_steps_ <= REGION_STEP_PX;
  }

  const cv::Mat& disparity_;
  double pair_steps_;
  cv::Mat visited_;
  std::vector<cv::Point> region_;
};

/// CV_8UC1, 1 at seeds of regions smaller than `min_seeds`: where there is nothing to match, random matches
/// agree in small groups.
cv::Mat isolatedSeeds(const cv::Mat& disparity, double pair_steps, int min_seeds)
{
  cv::Mat isolated = cv::Mat::zeros(disparity.size(), CV_8UC1);
  // A grid of few seeds cannot have large regions.
  const int least = std::min(min_seeds, static_cast<int>(disparity.total() / 20));
  RegionSearch search(disparity, pair_steps);
  for (int row = 0; row < disparity.rows; ++row)
  {
    for (int column = 0; column < disparity.cols; ++column)
    {
      if (search.visited({column, row}))
      {
        continue;
      }
      const std::vector<cv::Point>& region = search.regionOf({column, row});
      if (static_cast<int>(region.size()) < least)
      {
        for (const cv::Point& seed : region)
        {
          isolated.at<std::uint8_t>(seed) = 1;
        }
      }
    }
  }
  return isolated;
}

/// Index of the position nearest to a value in an increasing list.
std::size_t nearestIndex(const std::vector<int>& positions, double value)
{
  const auto above = std::lower_bound(positions.begin(), positions.end(), value);
  if (above == positions.begin())
  {
    return 0;
  }
  const auto index = static_cast<std::size_t>(above - positions.begin());
  if (above == positions.end())
  {
    return index - 1;
  }
  return *above - value < value - positions[index - 1] ? index : index - 1;
}

void drawBlock(SparseDisparity& sparse, cv::Point seed, int spacing, float disparity, float confidence)
{
  const cv::Rect block = cv::Rect(seed.x - spacing / 2, seed.y - spacing / 2, spacing, spacing) &
                         cv::Rect(cv::Point(), sparse.disparity.size());
  sparse.disparity(block).setTo(disparity);
  sparse.confidence(block).setTo(confidence);
}

}  // namespace

SparseDisparity consistentMatches(const SeedMatches& there, const SeedMatches& back, const ViewPair& pair,
                                  const cv::Size& size, const PatchMatchOptions& options)
{
  SparseDisparity sparse{cv::Mat::zeros(size, CV_32FC1), cv::Mat::zeros(size, CV_32FC1)};
  const double pair_steps = cv::norm(pair.steps);
  const cv::Rect2d inner(options.border_px, options.border_px, size.width - 2.0 * options.border_px,
                         size.height - 2.0 * options.border_px);
  const cv::Mat isolated = isolatedSeeds(there.disparity, pair_steps, options.min_region_seeds);
  for (int row = 0; row < there.disparity.rows; ++row)
  {
    for (int column = 0; column < there.disparity.cols; ++column)
    {
      const cv::Point seed(there.columns_px[static_cast<std::size_t>(column)],
                           there.rows_px[static_cast<std::size_t>(row)]);
      const float disparity = there.disparity.at<float>(row, column);
      const cv::Point2d target = cv::Point2d(seed) - disparity * pair.steps + pair.offset_px;
      const float centre_share = there.centre_share.at<float>(row, column);
      if (isolated.at<std::uint8_t>(row, column) != 0 || centre_share <= 0.0F || !inner.contains(target))
      {
        continue;
      }
      const float returned =
          back.disparity.at<float>(static_cast<int>(nearestIndex(back.rows_px, target.y)),
                                   static_cast<int>(nearestIndex(back.columns_px, target.x)));
      const double disagreement_px = std::abs(disparity - returned) * pair_steps;
      if (disagreement_px <= options.consistency_threshold_px)
      {
        const double deviations = disagreement_px / options.confidence_sigma_px;
        const float share = options.weigh_by_centre ? centre_share : 1.0F;
        drawBlock(sparse, seed, options.grid_spacing_px, disparity,
                  share * static_cast<float>(std::exp(-0.5 * deviations * deviations)));
      }
    }
  }
  return sparse;
}

}  // namespace light_field_depth
