#include "core/multiview/refine/known_around.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
constexpr int CELL_PX = 32;
/// Of a pixel of which something is known: gloss and paper of real cameras have some 5 to 70, blank walls 0.
constexpr float KNOWN_WEIGHT = 3.0F;
/// Every second pixel of every second row is looked at.
constexpr int STRIDE_PX = 2;
/// Of those, how many a cell needs, and the part of them that may lie beyond what counts as its farthest or
/// nearest: what matches wrongly is seldom more.
constexpr std::size_t MIN_KNOWN_PIXELS = 8;
constexpr double BEYOND_PART = 0.1;
constexpr float NOTHING = std::numeric_limits<float>::max();

/// The least value that is known in each cell, NOTHING where none is. Greatest ones are those of the negative
/// map.
struct Cells
{
  cv::Mat farthest;
  cv::Mat nearest;  ///< negative
};

void setCell(const cv::Mat& weight, const cv::Mat& disparity, const cv::Rect& cell, float& farthest,
             float& nearest)
{
  std::vector<float> known;
  for (int y = cell.y; y < cell.y + cell.height; y += STRIDE_PX)
  {
    const auto* const weights = weight.ptr<float>(y);
    const auto* const row = disparity.ptr<float>(y);
    for (int x = cell.x; x < cell.x + cell.width; x += STRIDE_PX)
    {
      if (weights[x] > KNOWN_WEIGHT)
      {
        known.push_back(row[x]);
      }
    }
  }
  if (known.size() < MIN_KNOWN_PIXELS)
  {
    farthest = nearest = NOTHING;
    return;
  }
  const auto beyond = static_cast<std::ptrdiff_t>(BEYOND_PART * static_cast<double>(known.size()));
  const auto low = known.begin() + beyond;
  std::nth_element(known.begin(), low, known.end());
  farthest = *low;
  const auto high = known.end() - 1 - beyond;
  std::nth_element(low, high, known.end());
  nearest = -*high;
}

cv::Mat leastOfFour(const cv::Mat& cells)
{
  cv::Mat least((cells.rows + 1) / 2, (cells.cols + 1) / 2, CV_32FC1, cv::Scalar(NOTHING));
  for (int y = 0; y < cells.rows; ++y)
  {
    for (int x = 0; x < cells.cols; ++x)
    {
      float& value = least.at<float>(y / 2, x / 2);
      value = std::min(value, cells.at<float>(y, x));
    }
  }
  return least;
}

/// The least of each cell and those about it, of the smallest cells of which one is known.
void spread(cv::Mat& cells)
{
  cv::Mat least;
  cv::erode(cells, least, cv::Mat::ones(3, 3, CV_8UC1), {-1, -1}, 1, cv::BORDER_REPLICATE);
  if (cells.total() > 1)
  {
    cv::Mat larger = leastOfFour(cells);
    spread(larger);
    for (int y = 0; y < least.rows; ++y)
    {
      for (int x = 0; x < least.cols; ++x)
      {
        float& value = least.at<float>(y, x);
        value = value == NOTHING ? larger.at<float>(y / 2, x / 2) : value;
      }
    }
  }
  cells = least;
}

Cells findCells(const cv::Mat& weight, const cv::Mat& disparity, ThreadPool& pool)
{
  const cv::Rect whole(0, 0, disparity.cols, disparity.rows);
  const cv::Size size((disparity.cols + CELL_PX - 1) / CELL_PX, (disparity.rows + CELL_PX - 1) / CELL_PX);
  Cells cells{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1)};
  pool.parallelFor(0, size.height, 1,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       for (int x = 0; x < size.width; ++x)
                       {
                         const cv::Rect cell(x * CELL_PX, y * CELL_PX, CELL_PX, CELL_PX);
                         setCell(weight, disparity, cell & whole, cells.farthest.at<float>(y, x),
                                 cells.nearest.at<float>(y, x));
                       }
                     }
                   });
  spread(cells.farthest);
  spread(cells.nearest);
  return cells;
}

}  // namespace

void bringToKnownAround(const cv::Mat& weight, ThreadPool& pool, cv::Mat& disparity)
{
  const Cells cells = findCells(weight, disparity, pool);
  if (cells.farthest.at<float>(0, 0) == NOTHING)
  {
    return;  // nothing is known anywhere
  }
  cv::Mat low;
  cv::Mat high;  // negative
  cv::resize(cells.farthest, low, disparity.size(), 0.0, 0.0, cv::INTER_LINEAR);
  cv::resize(cells.nearest, high, disparity.size(), 0.0, 0.0, cv::INTER_LINEAR);
  pool.parallelFor(0, disparity.rows, CELL_PX,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const weights = weight.ptr<float>(y);
                       const auto* const farthest = low.ptr<float>(y);
                       const auto* const nearest = high.ptr<float>(y);
                       auto* const row = disparity.ptr<float>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const float between = std::max(std::min(row[x], -nearest[x]), farthest[x]);
                         row[x] = weights[x] > KNOWN_WEIGHT ? row[x] : between;
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
