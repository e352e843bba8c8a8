#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/smoothing_kernels.h"
#include "core/multiview/refine/smoothing_system.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::equal;
using testing::randomMap;
using testing::SmoothingSystem;

constexpr int WIDTH = 203;  // no multiple of any vector

class SmoothingKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, SmoothingKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

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
      const SmoothingSystem system(2 * count, width);
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
  const SmoothingSystem system(3, WIDTH);
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
  const SmoothingSystem system(2, WIDTH);
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

}  // namespace
}  // namespace light_field_depth::multiview
