#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/run_context.h"

namespace light_field_depth
{
namespace
{
TEST(RunContext, StagesStandInTheOrderOfTheirFirstAppearanceAndRepeatedOnesAreAddedUp)
{
  ThreadPool pool(1);
  RunContext context(pool);
  for (const char* const stage : {"cost", "aggregate", "cost"})
  {
    const StageTimer timer(context, stage);
  }
  ASSERT_EQ(context.stage_times.size(), 2U);
  EXPECT_EQ(context.stage_times[0].stage, "cost");
  EXPECT_EQ(context.stage_times[1].stage, "aggregate");
  const double before = context.stage_times[0].milliseconds;
  {
    const StageTimer timer(context, "cost");
  }
  EXPECT_GT(context.stage_times[0].milliseconds, before);
}

TEST(RunContext, SavesWhereSomebodyWantsItAndLeavesEmptyOnesOut)
{
  ThreadPool pool(1);
  RunContext context(pool);
  const cv::Mat values(2, 3, CV_32FC1, 1.5F);
  context.save("nobody", values);
  std::vector<std::string> names;
  context.save_intermediate = [&](const std::string& name, const cv::Mat& /*values*/)
  { names.push_back(name); };
  context.save("map", values);
  context.save("empty", cv::Mat());
  EXPECT_EQ(names, (std::vector<std::string>{"map"}));
}

}  // namespace
}  // namespace light_field_depth
