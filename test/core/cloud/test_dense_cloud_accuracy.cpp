// The figures of the dense cloud on the bundled light field, against the exact truth of five of its views.

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/evaluation/cloud_score.h"
#include "light_field_depth/io/dataset.h"
#include "tools/cloud_truth.h"

namespace light_field_depth
{
namespace
{
/// Every fourth point is enough for accuracy; completeness within 0.25 % is lower than with all of them
/// by 3.5 points.
constexpr std::size_t SCORED_SHARE = 4;

CloudScore scoreOf(int maps)
{
  const std::filesystem::path folder = std::filesystem::path(DEMO_FOLDER);
  const Dataset dataset = readDataset(folder);
  PipelineOptions options;
  options.dense_cloud.maps = maps;
  std::vector<cv::Point3f> points;
  std::size_t seen = 0;
  ProductRequest request;
  request.dense_cloud = true;
  request.dense_cloud_sink = [&](const DensePoint* block, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (seen++ % SCORED_SHARE == 0)
      {
        points.emplace_back(block[i].x, block[i].y, block[i].z);
      }
    }
  };
  Pipeline pipeline;
  pipeline.run(dataset.light_field, options, request);
  ThreadPool pool;
  return scoreCloud(points, readCloudTruth(folder), pool);
}

TEST(DenseCloudAccuracy, OfOneMapHasFewFlyingPoints)
{
  const CloudScore score = scoreOf(1);
  EXPECT_GT(score.accuracy_025, 68.5);
  EXPECT_GT(score.accuracy_1, 95.8);
  EXPECT_LT(score.off_2, 0.8);
  EXPECT_LT(score.flying, 0.35) << "1.0 without the filter of rims";
  EXPECT_GT(score.completeness_2, 97.0) << "91.9 without the blank wall, which a plane holds";
}

TEST(DenseCloudAccuracy, OfFiveMapsIsBetterInEveryRespect)
{
  const CloudScore score = scoreOf(5);
  EXPECT_GT(score.accuracy_025, 73.0);
  EXPECT_GT(score.accuracy_1, 97.5);
  EXPECT_LT(score.off_2, 0.2);
  EXPECT_LT(score.flying, 0.1);
  EXPECT_GT(score.completeness_025, 71.0) << "of a quarter of the points";
  EXPECT_GT(score.completeness_2, 97.0);
  EXPECT_GT(score.hidden_1, 60.0);
  EXPECT_GT(score.hidden_2, 80.0);
}

}  // namespace
}  // namespace light_field_depth
