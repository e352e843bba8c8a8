#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/light_field/pixel_kernels.h"
#include "core/multiview/refine/coarse_correction.h"
#include "core/multiview/refine/edge_aware_smoothing.h"
#include "core/multiview/refine/smoothing_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 203;  // no multiple of any vector
constexpr int HEIGHT = 150;

cv::Mat randomMap(int height, int width, float low, float high)
{
  static std::mt19937 engine(5);
  std::uniform_real_distribution<float> distribution(low, high);
  cv::Mat map(height, width, CV_32FC1);
  std::generate(map.begin<float>(), map.end<float>(), [&] { return distribution(engine); });
  return map;
}

bool equal(const cv::Mat& a, const cv::Mat& b)
{
  return std::equal(a.begin<float>(), a.end<float>(), b.begin<float>(), b.end<float>());
}

/// Everything that a system is made of.
struct System
{
  explicit System(int height, int width)
      : weight(randomMap(height, width, 0.0F, 400.0F)), target(randomMap(height, width, -3.0F, 3.0F)),
        left(randomMap(height, width + 1, 0.0F, 200.0F)), up(randomMap(height + 1, width, 0.0F, 200.0F)),
        disparity(randomMap(height, width, -3.0F, 3.0F))
  {
    left.col(0).setTo(0.0F);
    left.col(width).setTo(0.0F);
    up.row(0).setTo(0.0F);
    up.row(height).setTo(0.0F);
  }

  SystemRow row(int y, cv::Mat& values) const
  {
    return {weight.ptr<float>(y),
            target.ptr<float>(y),
            left.ptr<float>(y),
            up.ptr<float>(y),
            up.ptr<float>(y + 1),
            values.ptr<float>(std::max(y - 1, 0)),
            values.ptr<float>(std::min(y + 1, values.rows - 1)),
            values.ptr<float>(y)};
  }

  cv::Mat weight;
  cv::Mat target;
  cv::Mat left;
  cv::Mat up;
  cv::Mat disparity;
};

class SmoothingKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, SmoothingKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(SmoothingKernels, ChangesOfColourEqualThePlainVersion)
{
  std::mt19937 engine(3);
  std::vector<std::uint8_t> pixels(6 * 256);
  std::generate(pixels.begin(), pixels.end(), [&] { return static_cast<std::uint8_t>(engine()); });
  for (const int channels : {1, 3})
  {
    const ColourChangeRow row{pixels.data() + 1, pixels.data() + 3 * 256, 256, channels, WIDTH};
    std::vector<std::uint16_t> left(WIDTH);
    std::vector<std::uint16_t> above(WIDTH);
    std::vector<std::uint16_t> left_plain(WIDTH);
    std::vector<std::uint16_t> above_plain(WIDTH);
    colourChanges(row, left.data(), above.data());
    colourChangesPlain(row, left_plain.data(), above_plain.data());
    EXPECT_EQ(left, left_plain);
    EXPECT_EQ(above, above_plain);
    EXPECT_EQ(left[0] == left[1] && left[1] == left[2], false);
  }
}

TEST_P(SmoothingKernels, LinksEqualThePlainVersion)
{
  const cv::Mat guide = randomMap(2, WIDTH, 0.0F, 200.0F);
  const cv::Mat disparity = randomMap(2, WIDTH, 0.0F, 0.1F);
  const cv::Mat slopes = randomMap(2, WIDTH, -0.01F, 0.01F);
  for (const int width : {1, 2, 33, WIDTH})
  {
    std::vector<cv::Mat> links(4);
    std::generate(links.begin(), links.end(), [&] { return randomMap(1, width + 1, -1.0F, -0.5F); });
    LinkRow row{guide.ptr<float>(0),
                guide.ptr<float>(1),
                disparity.ptr<float>(1),
                disparity.ptr<float>(0),
                slopes.ptr<float>(0),
                slopes.ptr<float>(1),
                width,
                0.015F,
                links[0].ptr<float>(),
                links[1].ptr<float>()};
    linkRow(row);
    row.left = links[2].ptr<float>();
    row.up = links[3].ptr<float>();
    linkRowPlain(row);
    EXPECT_TRUE(equal(links[0], links[2])) << width;
    EXPECT_TRUE(equal(links[1].colRange(0, width), links[3].colRange(0, width))) << width;
    EXPECT_EQ(links[0].at<float>(0, 0), 0.0F);
    EXPECT_EQ(links[0].at<float>(0, width), 0.0F);
  }
}

TEST_P(SmoothingKernels, RowsSolvedSideBySideEqualThePlainVersion)
{
  for (const int width : {1, 2, 3, 31, 32, 65, WIDTH})
  {
    for (const int count : {1, 7, ROWS_AT_ONCE})
    {
      const System system(2 * count, width);
      std::vector<float> scratch(rowScratch(width));
      cv::Mat simd = system.disparity.clone();
      cv::Mat plain = system.disparity.clone();
      std::vector<SystemRow> rows;
      std::vector<SystemRow> rows_plain;
      for (int r = 0; r < count; ++r)
      {
        rows.push_back(system.row(2 * r, simd));
        rows_plain.push_back(system.row(2 * r, plain));
      }
      solveRows(rows.data(), count, width, scratch.data());
      solveRowsPlain(rows_plain.data(), count, width, scratch.data());
      EXPECT_TRUE(equal(simd, plain)) << count << " rows of " << width;
      EXPECT_FALSE(equal(simd, system.disparity));
    }
  }
}

/// Each unknown is the mean of its target and its neighbours with their weights.
TEST_P(SmoothingKernels, SolvedRowsFulfilTheirEquations)
{
  const System system(3, WIDTH);
  cv::Mat values = system.disparity.clone();
  std::vector<float> scratch(rowScratch(WIDTH));
  const SystemRow row = system.row(1, values);
  solveRows(&row, 1, WIDTH, scratch.data());
  for (int x = 1; x + 1 < WIDTH; ++x)
  {
    const double data = row.weight[x] + TINY_WEIGHT;
    const double sum = data * row.target[x] + row.left[x] * row.values[x - 1] +
                       row.left[x + 1] * row.values[x + 1] + row.up[x] * row.above[x] +
                       row.down[x] * row.below[x];
    const double weights = data + row.left[x] + row.left[x + 1] + row.up[x] + row.down[x];
    EXPECT_NEAR(row.values[x], sum / weights, 1e-5) << x;
  }
}

TEST_P(SmoothingKernels, StepsAlongColumnsEqualThePlainVersion)
{
  const System system(2, WIDTH);
  const cv::Mat above = randomMap(2, WIDTH, 0.0F, 0.9F);
  for (const auto& columns : {cv::Range(0, WIDTH), cv::Range(0, 64), cv::Range(64, 71), cv::Range(1, 2)})
  {
    cv::Mat results[4];
    for (auto& result : results)
    {
      result = cv::Mat::zeros(1, columns.size(), CV_32FC1);
    }
    ColumnStep step{system.weight.ptr<float>(1),
                    system.target.ptr<float>(1),
                    system.left.ptr<float>(1),
                    system.up.ptr<float>(1),
                    system.up.ptr<float>(1),
                    system.disparity.ptr<float>(1),
                    columns.start,
                    columns.end,
                    WIDTH,
                    above.ptr<float>(0),
                    above.ptr<float>(1),
                    results[0].ptr<float>(),
                    results[1].ptr<float>()};
    eliminateColumns(step);
    step.factor = results[2].ptr<float>();
    step.value = results[3].ptr<float>();
    eliminateColumnsPlain(step);
    EXPECT_TRUE(equal(results[0], results[2])) << columns.start << " to " << columns.end;
    EXPECT_TRUE(equal(results[1], results[3])) << columns.start << " to " << columns.end;
    substituteColumns(step.value, step.factor, above.ptr<float>(0), columns.size(), results[0].ptr<float>());
    substituteColumnsPlain(step.value, step.factor, above.ptr<float>(0), columns.size(),
                           results[1].ptr<float>());
    EXPECT_TRUE(equal(results[0], results[1])) << columns.start << " to " << columns.end;
  }
}

/// Rows, then columns, as the description of the line solver says, without bands and chunks.
void sweepPlainly(const System& system, cv::Mat& values)
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
  System system(height, width);
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
