#include "core/multiview/maps/left_right_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
constexpr std::uint8_t MARKED = 255;  // as in OpenCV's masks

/// Marks small regions of unmarked pixels.
class RegionCleaner
{
public:
  RegionCleaner(const cv::Mat& disparity, float max_step, cv::Mat& marked)
      : disparity_(disparity), max_step_(max_step), marked_(marked),
        seen_(cv::Mat::zeros(marked.size(), CV_8UC1))
  {
  }

  void markSmallerThan(int min_region_px)
  {
    for (int y = 0; y < marked_.rows; ++y)
    {
      for (int x = 0; x < marked_.cols; ++x)
      {
        if (!isOpen({x, y}))
        {
          continue;
        }
        collectRegionAt({x, y});
        if (region_.size() < static_cast<std::size_t>(min_region_px))
        {
          std::for_each(region_.begin(), region_.end(),
                        [&](const cv::Point& pixel) { marked_.at<std::uint8_t>(pixel) = MARKED; });
        }
      }
    }
  }

private:
  bool isOpen(const cv::Point& pixel) const
  {
    return marked_.at<std::uint8_t>(pixel) == 0 && seen_.at<std::uint8_t>(pixel) == 0;
  }

  void take(const cv::Point& pixel)
  {
    seen_.at<std::uint8_t>(pixel) = 1;
    region_.push_back(pixel);
  }

  void collectRegionAt(const cv::Point& start)
  {
    const std::array<cv::Point, 4> neighbours = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const cv::Rect inside({}, marked_.size());
    region_.clear();
    take(start);
    for (std::size_t i = 0; i < region_.size(); ++i)
    {
      const cv::Point from = region_[i];
      for (const cv::Point& step : neighbours)
      {
        const cv::Point to = from + step;
        if (inside.contains(to) && isOpen(to) &&
            std::abs(disparity_.at<float>(to) - disparity_.at<float>(from)) <= max_step_)
        {
          take(to);
        }
      }
    }
  }

  const cv::Mat& disparity_;
  float max_step_;
  cv::Mat& marked_;
  cv::Mat seen_;
  std::vector<cv::Point> region_;
};

/// Gives each run of marked pixels in a row the smaller of the values at its ends.
void fillRuns(const std::uint8_t* marked, int width, float* row)
{
  int x = 0;
  while (x < width)
  {
    if (marked[x] == 0)
    {
      ++x;
      continue;
    }
    const int first = x;
    while (x < width && marked[x] != 0)
    {
      ++x;
    }
    const bool left = first > 0;
    const bool right = x < width;
    if (left || right)
    {
      const float value = !left ? row[x] : !right ? row[first - 1] : std::min(row[first - 1], row[x]);
      std::fill(row + first, row + x, value);
    }
  }
}

/// Rows without a single unmarked pixel take over the next one that has some.
void copyIntoEmptyRows(const cv::Mat& marked, cv::Mat& disparity)
{
  std::vector<int> filled;
  for (int y = 0; y < marked.rows; ++y)
  {
    if (cv::countNonZero(marked.row(y)) < marked.cols)
    {
      filled.push_back(y);
    }
  }
  if (filled.empty())
  {
    return;
  }
  for (int y = 0; y < marked.rows; ++y)
  {
    const auto after = std::lower_bound(filled.begin(), filled.end(), y);
    const int next = after == filled.end() ? filled.back() : *after;
    const int before = after == filled.begin() ? filled.front() : *(after - 1);
    const int source = std::abs(next - y) <= std::abs(y - before) ? next : before;
    if (source != y)
    {
      disparity.row(source).copyTo(disparity.row(y));
    }
  }
}

/// exp(-difference / scale) for the summed difference of the channels.
std::vector<float> colourWeights(int channels, float colour_scale)
{
  std::vector<float> weights(static_cast<std::size_t>(255 * channels + 1));
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    weights[i] = std::exp(-static_cast<float>(i) / (colour_scale * static_cast<float>(channels)));
  }
  return weights;
}

/// The median about single pixels.
class ColourMedian
{
public:
  ColourMedian(const cv::Mat& image, const cv::Mat& disparity, const BackgroundFillSettings& settings)
      : image_(image), disparity_(disparity), radius_(settings.radius_px), stride_(settings.stride_px),
        weights_(colourWeights(image.channels(), settings.colour_scale))
  {
  }

  /// Mean difference of the channels of two pixels, in levels.
  int colourStep(const cv::Point& a, const cv::Point& b) const
  {
    const int channels = image_.channels();
    const auto colour = [&](const cv::Point& pixel)
    { return image_.ptr<std::uint8_t>(pixel.y) + static_cast<std::ptrdiff_t>(pixel.x) * channels; };
    int difference = 0;
    for (int channel = 0; channel < channels; ++channel)
    {
      difference += std::abs(colour(a)[channel] - colour(b)[channel]);
    }
    return difference / channels;
  }

  float at(int x, int y)
  {
    samples_.clear();
    const float total = image_.channels() == 1 ? collect<1>(x, y) : collect<3>(x, y);
    return weightedMedian(0.5F * total);
  }

private:
  /// @return the sum of the weights
  template <int CHANNELS>
  float collect(int x, int y)
  {
    // Of the columns (rows) x - radius, x - radius + stride, ... the first one inside of the image.
    const auto first_in = [&](int centre)
    {
      const int first = centre - radius_;
      return first >= 0 ? first : first + (stride_ - 1 - first) / stride_ * stride_;
    };
    const int left = first_in(x);
    const int top = first_in(y);
    const int right = std::min(x + radius_, disparity_.cols - 1);
    const int bottom = std::min(y + radius_, disparity_.rows - 1);
    const std::uint8_t* const here = image_.ptr<std::uint8_t>(y) + static_cast<std::ptrdiff_t>(x) * CHANNELS;
    float total = 0.0F;
    for (int row = top; row <= bottom; row += stride_)
    {
      const auto* const values = disparity_.ptr<float>(row);
      const std::uint8_t* const colours = image_.ptr<std::uint8_t>(row);
      for (int column = left; column <= right; column += stride_)
      {
        const std::uint8_t* const there = colours + static_cast<std::ptrdiff_t>(column) * CHANNELS;
        int difference = 0;
        for (int channel = 0; channel < CHANNELS; ++channel)
        {
          difference += std::abs(here[channel] - there[channel]);
        }
        const float weight = weights_[static_cast<std::size_t>(difference)];
        samples_.emplace_back(values[column], weight);
        total += weight;
      }
    }
    return total;
  }

  /// The least value of the samples up to which their weights sum up to this: only the part in which it lies
  /// is looked at again.
  float weightedMedian(float half)
  {
    auto first = samples_.begin();
    auto last = samples_.end();
    while (last - first > 1)
    {
      const float pivot = first[(last - first) / 2].first;
      float below = 0.0F;
      float equal = 0.0F;
      auto small_end = first;
      auto equal_end = first;
      for (auto sample = first; sample != last; ++sample)
      {
        if (sample->first > pivot)
        {
          continue;
        }
        std::swap(*sample, *equal_end);
        if (equal_end->first < pivot)
        {
          below += equal_end->second;
          std::swap(*equal_end, *small_end++);
        }
        else
        {
          equal += equal_end->second;
        }
        ++equal_end;
      }
      if (half <= below)
      {
        last = small_end;
      }
      else if (half <= below + equal || equal_end == last)
      {
        return pivot;  // at the very end rounding may have left a little weight over
      }
      else
      {
        half -= below + equal;
        first = equal_end;
      }
    }
    return first->first;
  }

  const cv::Mat& image_;
  const cv::Mat& disparity_;
  int radius_;
  int stride_;
  std::vector<float> weights_;
  std::vector<std::pair<float, float>> samples_;
};

void fillAlongRows(const cv::Mat& image, const cv::Mat& marked, const BackgroundFillSettings& settings,
                   ThreadPool& pool, cv::Mat& disparity)
{
  for (int y = 0; y < disparity.rows; ++y)
  {
    fillRuns(marked.ptr<std::uint8_t>(y), disparity.cols, disparity.ptr<float>(y));
  }
  copyIntoEmptyRows(marked, disparity);
  const cv::Mat filled = disparity.clone();
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     ColourMedian median(image, filled, settings);
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const mark = marked.ptr<std::uint8_t>(y);
                       auto* const row = disparity.ptr<float>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         if (mark[x] == 0)
                         {
                           continue;
                         }
                         const auto is_like = [&](int from_x, int from_y)
                         {
                           return marked.at<std::uint8_t>(from_y, from_x) != 0 &&
                                  median.colourStep({x, y}, {from_x, from_y}) <= settings.max_colour_step;
                         };
                         if ((y - first) % 2 == 1 && is_like(x, y - 1))
                         {
                           row[x] = disparity.at<float>(y - 1, x);
                         }
                         else if (x % 2 == 1 && is_like(x - 1, y))
                         {
                           row[x] = row[x - 1];
                         }
                         else
                         {
                           row[x] = median.at(x, y);
                         }
                       }
                     }
                   });
}

}  // namespace

cv::Mat findUnconfirmed(const cv::Mat& disparity, const View& other, const cv::Mat& other_disparity,
                        const LeftRightSettings& settings, ThreadPool& pool)
{
  const auto distance = static_cast<float>(std::hypot(other.steps.x, other.steps.y));
  const float max_difference = settings.max_distance_px / distance;
  const cv::Point2f scale(static_cast<float>(other_disparity.cols) / static_cast<float>(disparity.cols),
                          static_cast<float>(other_disparity.rows) / static_cast<float>(disparity.rows));
  const cv::Point2f steps(other.steps);
  const cv::Point2f offset(other.offset_px);
  cv::Mat marked(disparity.size(), CV_8UC1, cv::Scalar(MARKED));
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const row = disparity.ptr<float>(y);
                       auto* const mark = marked.ptr<std::uint8_t>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const float seen_x = static_cast<float>(x) + 0.5F + offset.x - row[x] * steps.x;
                         const float seen_y = static_cast<float>(y) + 0.5F + offset.y - row[x] * steps.y;
                         const cv::Point at(static_cast<int>(std::floor(seen_x * scale.x)),
                                            static_cast<int>(std::floor(seen_y * scale.y)));
                         if (at.x >= 0 && at.x < other_disparity.cols && at.y >= 0 &&
                             at.y < other_disparity.rows &&
                             std::abs(row[x] - other_disparity.at<float>(at)) <= max_difference)
                         {
                           mark[x] = 0;
                         }
                       }
                     }
                   });
  RegionCleaner(disparity, settings.max_step_px / distance, marked).markSmallerThan(settings.min_region_px);
  return marked;
}

void fillFromBackground(const cv::Mat& image, const cv::Mat& marked, bool along_columns,
                        const BackgroundFillSettings& settings, ThreadPool& pool, cv::Mat& disparity)
{
  if (!along_columns)
  {
    fillAlongRows(image, marked, settings, pool, disparity);
    return;
  }
  cv::Mat turned_image = image.t();
  cv::Mat turned_marked = marked.t();
  cv::Mat turned = disparity.t();
  fillAlongRows(turned_image, turned_marked, settings, pool, turned);
  disparity = turned.t();
}

}  // namespace light_field_depth::multiview
