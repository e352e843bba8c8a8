#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/coarse_correction.h"
#include "core/multiview/refine/edge_aware_smoothing.h"
#include "core/multiview/refine/smoothing_kernels.h"
#include "core/multiview/refine/smoothing_system.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::equal;
using testing::randomMap;
using testing::SmoothingSystem;

constexpr int WIDTH = 203;  // no multiple of any vector
constexpr int HEIGHT = 150;

/// Rows, then columns, as the description of the line solver says, without bands and chunks.
void sweepPlainly(const SmoothingSystem& system, cv::Mat& values)
{
  const int width = values.cols;
  std::vector<float> scratch(rowScratch(width));
  for (const int parity : {0, 1})
  {
    for (int y = parity; y < values.rows; y += 2)
    {
      const SystemRow row = system.row(y, values);
      solveRowsPlain(&row, 1, width, scratch.data());
    }
  }
  cv::Mat factor(values.size(), CV_32FC1);
  cv::Mat value(values.size(), CV_32FC1);
  for (int y = 0; y < values.rows; ++y)
  {
    const int above = std::max(y - 1, 0);
    const SystemRow row = system.row(y, values);
    const float* const none = system.up.ptr<float>(0);
    eliminateColumnsPlain({row.weight, row.target, row.left, row.up, row.down, row.values, 0, width, width,
                           y > 0 ? factor.ptr<float>(above) : none, y > 0 ? value.ptr<float>(above) : none,
                           factor.ptr<float>(y), value.ptr<float>(y)});
  }
  value.copyTo(values);
  for (int y = values.rows - 2; y >= 0; --y)
  {
    substituteColumnsPlain(value.ptr<float>(y), factor.ptr<float>(y), values.ptr<float>(y + 1), width,
                           values.ptr<float>(y));
  }
}

/// The smoothing as its description says, without bands and chunks but for the correction on coarser grids.
cv::Mat smoothedPlainly(const PlanarImage& guide, const cv::Mat& weight, const cv::Mat& target,
                        const SmoothingSettings& settings, const cv::Mat& start)
{
  const std::vector<float> level(static_cast<std::size_t>(target.cols), 0.0F);
  const int width = start.cols;
  const int height = start.rows;
  SmoothingSystem system(height, width);
  system.weight = weight;
  system.target = target;
  cv::Mat guide_left(height, width, CV_32FC1, cv::Scalar(0.0F));
  cv::Mat guide_above(height, width, CV_32FC1, cv::Scalar(0.0F));
  for (int y = 0; y < height; ++y)
  {
    const auto link = [&](const std::uint8_t* a, const std::uint8_t* b)
    {
      const auto change = static_cast<float>(colourDifference(guide, a, b));
      return settings.strength * std::exp(-settings.image_edge_decay * change / COLOUR_DIFFERENCES);
    };
    for (int x = 0; x < width; ++x)
    {
      guide_left.at<float>(y, x) = x > 0 ? link(guide.row(y) + x - 1, guide.row(y) + x) : 0.0F;
      guide_above.at<float>(y, x) = y > 0 ? link(guide.row(y - 1) + x, guide.row(y) + x) : 0.0F;
    }
  }
  cv::Mat values = start.clone();
  ThreadPool pool(1);
  CoarseCorrection coarse;
  for (const float flat_px : settings.flat_px)
  {
    for (int y = 0; y < height; ++y)
    {
      linkRowPlain({guide_left.ptr<float>(y), guide_above.ptr<float>(y), values.ptr<float>(y),
                    values.ptr<float>(std::max(y - 1, 0)), level.data(), level.data(), width, flat_px,
                    system.left.ptr<float>(y), system.up.ptr<float>(y)});
    }
    sweepPlainly(system, values);
    coarse.correct({system.weight, system.target, system.left, system.up, values}, pool);
    sweepPlainly(system, values);
  }
  return values;
}

TEST(EdgeAwareSmoothing, BandsAndChunksChangeNothing)
{
  for (const cv::Size& size :
       {cv::Size(WIDTH, HEIGHT), cv::Size(64, 128), cv::Size(1, 1), cv::Size(2, 65), cv::Size(70, 1)})
  {
    PlanarImage guide;
    guide.create(size.width, size.height, 3, 8);
    for (int y = 0; y < size.height; ++y)
    {
      for (int i = 0; i < 3 * static_cast<int>(guide.channelStride()) - 8; ++i)
      {
        guide.row(y)[i] = static_cast<std::uint8_t>((i * i + 3 * y) % 13);
      }
    }
    const cv::Mat weight = randomMap(size.height, size.width, 0.0F, 400.0F);
    const cv::Mat target = randomMap(size.height, size.width, -1.0F, 1.0F);
    const cv::Mat start = randomMap(size.height, size.width, -1.0F, 1.0F);
    const SmoothingSettings settings;
    const cv::Mat expected = smoothedPlainly(guide, weight, target, settings, start);
    for (const int threads : {1, 3})
    {
      ThreadPool pool(threads);
      EdgeAwareSmoother smoother;
      smoother.setGuide(guide, settings, pool);
      cv::Mat disparity = start.clone();
      smoother.run(weight, target, settings, pool, disparity);
      EXPECT_TRUE(equal(disparity, expected)) << size << ", threads: " << threads;
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
