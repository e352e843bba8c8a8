// The parts of the benchmark that figures depend on, and the program as a user calls it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "ablation.h"
#include "chart.h"
#include "kernels.h"
#include "layered_scene.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_fields.h"
#include "report_files.h"
#include "stage_work.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
TEST(Benchmark, TakesTheMedian)
{
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 100.0}), 3.5);
  EXPECT_EQ(toText(Timing{{5.25, 1.0, 3.0}}), "3.0 (1.0..5.2)");
  EXPECT_EQ(toText(Timing{{50.4, 11.0, 30.0}}), "30 (11..50)");
}

TEST(Benchmark, RunsTasksInRoundsAndWarmsUpTheQuickOnes)
{
  std::vector<int> order;
  const std::vector<Timing> timings =
      timeInRounds({[&] { order.push_back(1); }, [&] { order.push_back(2); }}, 3);
  EXPECT_EQ(order, (std::vector<int>{1, 1, 2, 2, 1, 1, 2, 2, 1, 1, 2, 2}));
  ASSERT_EQ(timings.size(), 2U);
  EXPECT_EQ(timings[0].milliseconds.size(), 3U);
}

TEST(Benchmark, FitsPowerLaws)
{
  std::vector<ChartPoint> points;
  for (const double x : {1.0, 2.0, 5.0, 40.0})
  {
    points.push_back({x, 3.0 * std::pow(x, 1.25), 0.0, 0.0});
  }
  const PowerLaw fit = fitPowerLaw(points);
  EXPECT_NEAR(fit.exponent, 1.25, 1e-9);
  EXPECT_NEAR(fit.factor, 3.0, 1e-9);
}

TEST(Benchmark, WritesTablesInMarkdown)
{
  EXPECT_EQ(toMarkdown({{"a", "b"}, {{"1", ""}}, "Note."}), "| a | b |\n|---|---|\n| 1 |  |\n\nNote.\n");
}

TEST(Benchmark, EveryVariantCanBeRun)
{
  for (const auto& variants : {ablationVariants(), ownMethods()})
  {
    std::set<std::string> names;
    for (const Variant& variant : variants)
    {
      EXPECT_TRUE(names.insert(variant.name).second) << variant.name << " occurs twice";
      EXPECT_NO_THROW(optionsOf(variant)) << variant.name;
    }
  }
  EXPECT_TRUE(ablationVariants().front().settings.empty());
  EXPECT_NE(testing::messageOf<InputError>(
                [] {
                  optionsOf({"wrong", {"multiview_label_step_px=0"}});
                })
                .find("wrong"),
            std::string::npos);
}

/// The part of the reference's pixels that a view sees where a disparity says.
double shareSeenAt(const View& view, const cv::Mat& reference, double disparity)
{
  const int dx = static_cast<int>(std::lround(disparity * view.steps.x));
  const int dy = static_cast<int>(std::lround(disparity * view.steps.y));
  int seen = 0;
  int all = 0;
  for (int y = 0; y < reference.rows; ++y)
  {
    for (int x = 0; x < reference.cols; ++x)
    {
      const cv::Point at(x - dx, y - dy);
      if (at.inside(cv::Rect({}, reference.size())))
      {
        ++all;
        seen += reference.at<cv::Vec3b>(y, x) == view.image.at<cv::Vec3b>(at) ? 1 : 0;
      }
    }
  }
  return static_cast<double>(seen) / all;
}

TEST(Benchmark, TheWallOfTheLayeredSceneHasTheLeastDisparityInEveryView)
{
  const LightField scene = LayeredScene({160, 120}).views(crossOf(3));
  ASSERT_EQ(scene.views.size(), 5U);
  for (const View& view : scene.views)
  {
    EXPECT_LE(std::max(std::abs(view.steps.x), std::abs(view.steps.y)), LAYERED_SCENE_BASELINE);
    EXPECT_GT(shareSeenAt(view, scene.reference().image, LAYERED_SCENE_RANGE.min), 0.5) << view.grid.row;
  }
  EXPECT_LT(shareSeenAt(scene.views.front(), scene.reference().image, 0.0), 0.1);
  EXPECT_EQ(LayeredScene({64, 64}).views(gridOf(5)).views.size(), 25U);
}

TEST(Benchmark, EveryStageWhoseWorkIsKnownOccursInAFrame)
{
  Pipeline pipeline(2);
  std::set<std::string> stages;
  for (const StageTime& time : pipeline.run(LayeredScene({96, 96}).views(crossOf(9)), {}, {}).stage_times)
  {
    stages.insert(time.stage);
  }
  FrameSize frame;
  frame.pixels = 96 * 96;
  frame.views = 16;
  frame.labels = 29;
  for (const StageWork& work : stageWork(frame))
  {
    EXPECT_EQ(stages.count(work.stage), 1U) << work.stage << " is not a stage of the pipeline";
    EXPECT_GT(work.bytes, 0.0) << work.stage;
    EXPECT_EQ(work.operations > 0.0, work.lane != Lane::None) << work.stage;
  }
}

TEST(Benchmark, EveryKernelRunsWithAndWithoutVectors)
{
  std::set<std::string> names;
  for (const Kernel& kernel : kernels())
  {
    EXPECT_TRUE(names.insert(kernel.name).second) << kernel.name << " occurs twice";
    EXPECT_GT(kernel.items, 0.0) << kernel.name;
    EXPECT_GT(kernel.bytes, 0.0) << kernel.name;
    kernel.vectors();
    kernel.plain();
  }
}

TEST(Benchmark, TheProgramComparesAllMethodsOnTheDemo)
{
  const testing::TemporaryFolder folder;
  const testing::Outcome outcome =
      testing::runProgram(testing::quoted(BENCH_PROGRAM) + " --runs 1 --input data/demo --results " +
                          testing::quoted(folder.path().string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto report = nlohmann::json::parse(readFile(folder / "light_fields.json"));
  const std::size_t open_cv_methods = 3;
  ASSERT_EQ(report["rows"].size(), ownMethods().size() + open_cv_methods);
  for (const auto& row : report["rows"])
  {
    EXPECT_GT(row["time"]["median_ms"].get<double>(), 0.0) << row["method"];
    EXPECT_GT(row["accuracy"]["mse_100"].get<double>(), 0.0) << row["method"];
    const bool yardstick = row["method"].get<std::string>().find("DIS") != std::string::npos;
    EXPECT_EQ(row["mse_to_that_of_dis"].get<double>() == 1.0, yardstick) << row["method"];
  }
  EXPECT_EQ(readFile(folder / "light_fields.md") + "\n" + readFile(folder / "confidence.md"), outcome.output);
}

}  // namespace
}  // namespace light_field_depth::benchmark
