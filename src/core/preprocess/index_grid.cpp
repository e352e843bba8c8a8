#include "light_field_depth/core/index_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
/// Set by hand: neighbouring views look alike at this size, and views rows apart do not.
constexpr int THUMBNAIL_SIDE_PX = 32;
/// Of the square root of the number of views: so many runs of a square grid are looked at.
constexpr double RUNS = 4.0;

double difference(const std::vector<cv::Mat>& thumbnails, int i, int j)
{
  const cv::Mat& a = thumbnails[static_cast<std::size_t>(i)];
  return cv::norm(a, thumbnails[static_cast<std::size_t>(j)], cv::NORM_L1) / static_cast<double>(a.total());
}

bool areThere(const std::vector<cv::Mat>& thumbnails, int i, int j)
{
  return !thumbnails[static_cast<std::size_t>(i)].empty() && !thumbnails[static_cast<std::size_t>(j)].empty();
}

/// Mean absolute differences of the views so many numbers apart; 0 for none.
std::vector<double> differencesByLag(const std::vector<cv::Mat>& thumbnails)
{
  const int count = static_cast<int>(thumbnails.size());
  std::vector<double> differences(thumbnails.size(), 0.0);
  for (int lag = 1; lag < count; ++lag)
  {
    double sum = 0.0;
    int pairs = 0;
    for (int i = 0; i + lag < count; ++i)
    {
      if (areThere(thumbnails, i, i + lag))
      {
        sum += difference(thumbnails, i, i + lag);
        ++pairs;
      }
    }
    differences[static_cast<std::size_t>(lag)] = pairs > 0 ? sum / pairs : 0.0;
  }
  return differences;
}

/// IndexGridOptions::max_dip of a length.
double dipAt(const std::vector<double>& by_lag, int length)
{
  const auto lag = static_cast<std::size_t>(length);
  const double beside = by_lag[lag - 1] + by_lag[lag + 1];
  const bool known = by_lag[lag - 1] > 0.0 && by_lag[lag + 1] > 0.0;
  return known ? 2.0 * by_lag[lag] / beside : 1.0;
}

/// Difference of neighbours across the ends of runs over that of others, if the first view stands so many
/// places behind the beginning of its run.
double jumpAt(const std::vector<cv::Mat>& thumbnails, int length, int first_place)
{
  double across = 0.0;
  double inside = 0.0;
  int ends = 0;
  int others = 0;
  for (int i = 0; i + 1 < static_cast<int>(thumbnails.size()); ++i)
  {
    if (!areThere(thumbnails, i, i + 1))
    {
      continue;
    }
    const bool is_end = (i + 1 + first_place) % length == 0;
    (is_end ? across : inside) += difference(thumbnails, i, i + 1);
    ++(is_end ? ends : others);
  }
  return ends > 0 && inside > 0.0 ? across / ends / (inside / others) : 0.0;
}

/// IndexGridOptions::max_fold of a length.
double foldAt(const std::vector<cv::Mat>& thumbnails, const std::vector<double>& by_lag, int length)
{
  const int count = static_cast<int>(thumbnails.size());
  double facing = 0.0;
  double usual = 0.0;
  for (int end = length; end < count; end += length)
  {
    // The two views at the end itself are neighbours in any order.
    for (int away = 1; away < length && end + away < count; ++away)
    {
      facing += difference(thumbnails, end - 1 - away, end + away);
      usual += by_lag[2 * static_cast<std::size_t>(away) + 1];
    }
  }
  return usual > 0.0 ? facing / usual : 1.0;
}

}  // namespace

int thumbnailsForRunLength(int views)
{
  return std::min(views, static_cast<int>(std::ceil(RUNS * std::sqrt(views))) + 2);
}

cv::Mat thumbnailOf(const cv::Mat& view)
{
  const double scale = static_cast<double>(THUMBNAIL_SIDE_PX) / std::max(view.cols, view.rows);
  const cv::Size size(std::max(2, static_cast<int>(std::lround(scale * view.cols))),
                      std::max(2, static_cast<int>(std::lround(scale * view.rows))));
  cv::Mat small;
  cv::resize(view, small, size, 0, 0, cv::INTER_AREA);
  cv::Mat thumbnail;
  toGrey(small).convertTo(thumbnail, CV_32F);
  return thumbnail;
}

RunLength findRunLength(const std::vector<cv::Mat>& thumbnails, int views, const IndexGridOptions& options)
{
  const std::vector<double> by_lag = differencesByLag(thumbnails);
  RunLength by_dip;
  RunLength by_fold;
  bool is_row = by_lag.size() > 2 && by_lag[1] > 0.0 && by_lag[2] >= options.min_growth_of_row * by_lag[1];
  const int longest = std::min(views / 2, static_cast<int>(thumbnails.size()) - 2);
  for (int length = 2; length <= longest; ++length)
  {
    if (views % length != 0)
    {
      continue;
    }
    const double dip = dipAt(by_lag, length);
    const double fold = foldAt(thumbnails, by_lag, length);
    is_row = is_row && std::min(dip, fold) >= options.min_of_row;
    if (dip < by_dip.dip)
    {
      by_dip = {length, false, dip, fold};
    }
    if (fold < by_fold.fold)
    {
      by_fold = {length, true, dip, fold};
    }
  }
  if (by_dip.dip <= options.max_dip)
  {
    return by_dip;
  }
  if (by_fold.fold <= options.max_fold)
  {
    return by_fold;
  }
  return {is_row ? views : 0, false, by_dip.dip, by_fold.fold};
}

RunLength findRunLengthWithGaps(const std::vector<cv::Mat>& thumbnails, int views, int max_missing_before,
                                const IndexGridOptions& options)
{
  const std::vector<double> by_lag = differencesByLag(thumbnails);
  RunLength best;
  bool is_row = by_lag.size() > 2 && by_lag[1] > 0.0 && by_lag[2] >= options.min_growth_of_row * by_lag[1];
  // Of two rows with one view missing, fewer than half are in one.
  const int longest = std::min((views + 1) / 2, static_cast<int>(thumbnails.size()) - 2);
  for (int length = 2; length <= longest; ++length)
  {
    const double dip = dipAt(by_lag, length);
    is_row = is_row && dip >= options.min_of_row;
    if (dip < best.dip)
    {
      best.length = length;
      best.dip = dip;
    }
  }
  if (best.dip > options.max_dip)
  {
    best.length = is_row ? views : 0;
    return best;
  }
  double largest_jump = 0.0;
  for (int place = 0; place <= std::min(max_missing_before, best.length - 1); ++place)
  {
    const double jump = jumpAt(thumbnails, best.length, place);
    if (jump > largest_jump)
    {
      largest_jump = jump;
      best.first_place = place;
    }
  }
  return best;
}

SquareWithoutCorners findSquareWithoutCorners(const std::vector<bool>& present, int max_missing_before)
{
  const int count = static_cast<int>(present.size());
  for (int before = 0; before <= std::min(1, max_missing_before); ++before)
  {
    for (int behind = 0; behind <= 1; ++behind)
    {
      const int places = before + count + behind;
      const int side = static_cast<int>(std::lround(std::sqrt(places)));
      if (side * side != places)
      {
        continue;
      }
      bool only_corners = true;
      for (int i = 0; i < count; ++i)
      {
        const int place = before + i;
        only_corners = only_corners &&
                       (present[static_cast<std::size_t>(i)] || place == side - 1 || place == places - side);
      }
      if (only_corners)
      {
        return {side, before};
      }
    }
  }
  return {};
}

}  // namespace light_field_depth
