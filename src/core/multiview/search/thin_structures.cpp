#include "core/multiview/search/thin_structures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
/// That of the median which would wipe the structures out.
constexpr int RADIUS = 2;
constexpr int SIZE = 2 * RADIUS + 1;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// How much nearer than its surroundings a structure has to be.
constexpr float MIN_JUMP_PX = 0.2F;
/// Sum of three channels: neighbours lose exp(-difference / scale) of their vote.
constexpr float COLOUR_SCALE = 30.0F;

using VoteTable = std::array<float, COLOUR_DIFFERENCES>;

VoteTable makeVotes()
{
  VoteTable votes{};
  for (std::size_t difference = 0; difference < votes.size(); ++difference)
  {
    votes[difference] = std::exp(-static_cast<float>(difference) / COLOUR_SCALE);
  }
  return votes;
}

/// The votes about one pixel.
class Neighbourhood
{
public:
  Neighbourhood(const PlanarImage& guide, const cv::Mat& searched, const VoteTable& votes, int x, int y)
  {
    const std::uint8_t* const centre = guide.row(y) + x;
    const int left = std::max(x - RADIUS, 0);
    const int right = std::min(x + RADIUS, searched.cols - 1);
    for (int row = std::max(y - RADIUS, 0); row <= std::min(y + RADIUS, searched.rows - 1); ++row)
    {
      const auto* const values = searched.ptr<float>(row);
      const std::uint8_t* const pixels = guide.row(row);
      for (int column = left; column <= right; ++column)
      {
        const float vote = votes[colourDifference(guide, centre, pixels + column)];
        entries_[count_++] = {values[column], vote};
        total_ += vote;
      }
    }
  }

  /// Whether most votes are for more than this disparity.
  bool medianIsAbove(float disparity) const
  {
    float above = 0.0F;
    for (std::size_t i = 0; i < count_; ++i)
    {
      above += entries_[i].first > disparity ? entries_[i].second : 0.0F;
    }
    return above > 0.5F * total_;
  }

  float median()
  {
    std::sort(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(count_));
    float below = 0.0F;
    std::size_t i = 0;
    while (i + 1 < count_ && below + entries_[i].second < 0.5F * total_)
    {
      below += entries_[i].second;
      ++i;
    }
    return entries_[i].first;
  }

private:
  std::array<std::pair<float, float>, SIZE * SIZE> entries_;
  std::size_t count_ = 0;
  float total_ = 0.0F;
};

}  // namespace

void keepThinStructures(const PlanarImage& guide, const cv::Mat& searched, ThreadPool& pool,
                        cv::Mat& disparity)
{
  cv::Mat nearest;
  cv::dilate(searched, nearest, cv::Mat::ones(SIZE, SIZE, CV_8UC1));
  const VoteTable votes = makeVotes();
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       auto* const row = disparity.ptr<float>(y);
                       const auto* const limit = nearest.ptr<float>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const float jump = row[x] + MIN_JUMP_PX;
                         if (limit[x] <= jump)
                         {
                           continue;
                         }
                         Neighbourhood neighbourhood(guide, searched, votes, x, y);
                         if (neighbourhood.medianIsAbove(jump))
                         {
                           row[x] = neighbourhood.median();
                         }
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
