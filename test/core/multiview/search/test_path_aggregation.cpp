#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/search/path_aggregation.h"
#include "core/multiview/search/path_kernels.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomValues;

/// An image and a cost volume whose size is no multiple of a tile.
struct Problem
{
  static constexpr int WIDTH = 75;
  static constexpr int HEIGHT = 41;
  static constexpr int LABELS = 19;
  std::vector<std::uint8_t> cost =
      randomValues<std::uint8_t>(static_cast<std::size_t>(WIDTH) * HEIGHT * LABELS, 0, 240, 8);
  PlanarImage guide;
  PathSettings settings;

  Problem()
  {
    guide.create(WIDTH, HEIGHT, 1, 8);
    const auto values = randomValues<std::uint8_t>(static_cast<std::size_t>(WIDTH) * HEIGHT, 0, 40, 9);
    for (int y = 0; y < HEIGHT; ++y)
    {
      std::copy_n(values.data() + static_cast<std::ptrdiff_t>(y) * WIDTH, WIDTH, guide.row(y));
    }
  }

  static std::size_t entry(const cv::Point& p, int label)
  {
    const int pixel = p.y * WIDTH + p.x;
    return static_cast<std::size_t>(pixel) * LABELS + static_cast<std::size_t>(label);
  }

  int costAt(int x, int y, int label) const { return cost[entry({x, y}, label)]; }

  CostVolume volume(const LabelBands& bands) const
  {
    CostVolume result;
    result.create(WIDTH, HEIGHT, bands, CostVolume::Capacity::Band);
    for (int y = 0; y < HEIGHT; ++y)
    {
      for (int x = 0; x < WIDTH; ++x)
      {
        const LabelBand& band = bands.at(y / TILE_PX, x / TILE_PX);
        for (int label = band.first; label < band.end(); ++label)
        {
          const int value = (y % TILE_PX * band.count + label - band.first) * TILE_PX + x % TILE_PX;
          result.values[result.tileOffset(y / TILE_PX, x / TILE_PX) + static_cast<std::size_t>(value)] =
              static_cast<std::uint8_t>(costAt(x, y, label));
        }
      }
    }
    return result;
  }

  cv::Mat solve(const LabelBands& bands, int threads) const
  {
    ThreadPool pool(threads);
    PathAggregator aggregator;
    aggregator.setGuide(guide, settings, pool);
    cv::Mat label;
    aggregator.aggregate(volume(bands), settings, pool, label);
    return label;
  }

  int largeChangePenalty(int x, int y, int from_x, int from_y) const
  {
    const int change = 3 * std::abs(guide.row(y)[x] - guide.row(from_y)[from_x]);
    const float step =
        static_cast<float>(settings.large_change_penalty) / (1.0F + static_cast<float>(change));
    return static_cast<int>(
        std::lround(std::max(LARGE_CHANGE_FLOOR * static_cast<float>(settings.small_change_penalty), step)));
  }

  /// The formulas of the headers, pixel by pixel: each pair of opposite paths in whole units.
  std::vector<int> sums() const
  {
    std::vector<int> total(cost.size(), 0);
    for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1)})
    {
      const std::vector<int> forth = pathAlong(step);
      const std::vector<int> back = pathAlong(-step);
      for (std::size_t i = 0; i < total.size(); ++i)
      {
        const int units = (forth[i] + back[i] + PACKED_UNIT / 2) / PACKED_UNIT;
        total[i] += std::min(units, MAX_PACKED);
      }
    }
    return total;
  }

private:
  std::vector<int> pathAlong(const cv::Point& step) const
  {
    std::vector<int> path(cost.size(), 0);
    for (int i = 0; i < WIDTH * HEIGHT; ++i)
    {
      const int pixel = step.x + step.y > 0 ? i : WIDTH * HEIGHT - 1 - i;
      addPath({pixel % WIDTH, pixel / WIDTH}, step, path);
    }
    return path;
  }

  void addPath(const cv::Point& pixel, const cv::Point& step, std::vector<int>& path) const
  {
    const cv::Point from = pixel - step;
    const bool begins = from.x < 0 || from.y < 0 || from.x >= WIDTH || from.y >= HEIGHT;
    int least = 0;
    if (!begins)
    {
      const auto first = path.begin() + static_cast<std::ptrdiff_t>(entry(from, 0));
      least = *std::min_element(first, first + LABELS);
    }
    for (int label = 0; label < LABELS; ++label)
    {
      int best = 0;
      if (!begins)
      {
        best =
            std::min(path[entry(from, label)], least + largeChangePenalty(pixel.x, pixel.y, from.x, from.y));
        best =
            label > 0 ? std::min(best, path[entry(from, label - 1)] + settings.small_change_penalty) : best;
        best = label + 1 < LABELS
                   ? std::min(best, path[entry(from, label + 1)] + settings.small_change_penalty)
                   : best;
      }
      path[entry(pixel, label)] = costAt(pixel.x, pixel.y, label) + best - least;
    }
  }
};

TEST(PathAggregator, IsTheRecursionOfItsFormula)
{
  const Problem problem;
  LabelBands bands;
  bands.setAll(Problem::WIDTH, Problem::HEIGHT, Problem::LABELS);
  const cv::Mat label = problem.solve(bands, 2);
  const auto sums = problem.sums();
  for (int y = 0; y < Problem::HEIGHT; ++y)
  {
    for (int x = 0; x < Problem::WIDTH; ++x)
    {
      const auto first = sums.begin() + static_cast<std::ptrdiff_t>(y * Problem::WIDTH + x) * Problem::LABELS;
      const auto best = std::min_element(first, first + Problem::LABELS) - first;
      ASSERT_NEAR(label.at<float>(y, x), static_cast<float>(best), 0.5F) << x << ", " << y;
    }
  }
}

TEST(PathAggregator, StaysInTheBandsAndDoesNotDependOnThreads)
{
  const Problem problem;
  LabelBands bands;
  bands.setAll(Problem::WIDTH, Problem::HEIGHT, Problem::LABELS);
  bands.at(0, 0) = {0, 1};
  bands.at(0, 1) = {12, 7};
  bands.at(1, 0) = {3, 8};
  bands.at(1, 1) = {2, 4};
  const cv::Mat label = problem.solve(bands, 1);
  for (int y = 0; y < Problem::HEIGHT; ++y)
  {
    for (int x = 0; x < Problem::WIDTH; ++x)
    {
      const LabelBand& band = bands.at(y / TILE_PX, x / TILE_PX);
      ASSERT_TRUE(band.contains(cvRound(label.at<float>(y, x)))) << x << ", " << y;
    }
  }
  EXPECT_EQ(cv::norm(label, problem.solve(bands, 3), cv::NORM_INF), 0.0);
}

TEST(LabelBands, HoldTheLabelsAroundAMap)
{
  LabelSpace space;
  space.first_px = -2.0F;
  space.step_px = 0.125F;
  space.count = 33;
  cv::Mat disparity(70, 100, CV_32FC1, 0.0F);
  disparity.at<float>(40, 60) = 1.0F;
  disparity.at<float>(0, 0) = -5.0F;
  ThreadPool pool(1);
  LabelBands bands;
  bands.setAround(disparity, space, 6, 2.0F, pool);
  EXPECT_EQ(bands.rows(), 3);
  EXPECT_EQ(bands.columns(), 4);
  EXPECT_EQ(bands.at(1, 1).first, 14);
  EXPECT_EQ(bands.at(1, 1).end(), 27);
  EXPECT_EQ(bands.at(1, 2).end(), 27);  // 4 pixels away
  EXPECT_EQ(bands.at(1, 3).end(), 19);
  EXPECT_EQ(bands.at(2, 1).end(), 19);  // too far
  EXPECT_EQ(bands.at(0, 0).first, 0);
}

}  // namespace
}  // namespace light_field_depth::multiview
