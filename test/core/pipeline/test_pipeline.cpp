#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
testing::SyntheticLightField scene()
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(5, 5);
  Calibration calibration;
  calibration.focal_length_px = 100.0;
  calibration.principal_point_px = {63.5, 47.5};
  calibration.baseline_m = 0.1;
  calibration.disparity_offset_px = 5.0;
  settings.calibration = calibration;
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

TEST(Pipeline, MakesWhatIsAskedForAndNothingElse)
{
  const auto input = scene();
  Pipeline pipeline(2);
  const PipelineResult bare = pipeline.run(input.light_field, {}, {});
  EXPECT_EQ(bare.estimate.disparity.size(), input.truth.size());
  EXPECT_TRUE(bare.depth.empty());
  EXPECT_TRUE(bare.organized_cloud.empty());
  EXPECT_TRUE(bare.dense_cloud.empty());
  ProductRequest request;
  request.depth = true;
  request.organized_cloud = true;
  const PipelineResult full = pipeline.run(input.light_field, {}, request);
  EXPECT_EQ(full.depth.size(), input.truth.size());
  EXPECT_EQ(full.organized_cloud.size(), input.truth.total());
}

TEST(Pipeline, FindsTheDisparityOfASyntheticScene)
{
  const auto input = scene();
  Pipeline pipeline(2);
  const PipelineResult result = pipeline.run(input.light_field, {}, {});
  EXPECT_LT(testing::meanAbsoluteError(result.estimate.disparity, input.truth), 0.3);
}

TEST(Pipeline, LeavesTheViewsAsTheyAre)
{
  for (const bool grey : {false, true})
  {
    testing::SceneSettings settings;
    settings.positions = testing::crossPositions(5, 5);
    settings.noise_sigma = 5.0;
    settings.grey = grey;
    const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
    std::vector<cv::Mat> before;
    for (const View& view : input.light_field.views)
    {
      before.push_back(view.image.clone());
    }
    for (const std::string& method : methodNames())
    {
      PipelineOptions options;
      options.method = methodFromString(method);
      Pipeline(2).run(input.light_field, options, {});
      for (std::size_t i = 0; i < before.size(); ++i)
      {
        EXPECT_EQ(cv::norm(before[i], input.light_field.views[i].image, cv::NORM_INF), 0.0)
            << method << (grey ? ", grey" : ", colour") << ", view " << i;
      }
    }
  }
}

/// What a progress sink is told in one run.
std::vector<std::pair<std::string, double>> progressOf(const LightField& light_field,
                                                       const PipelineOptions& options)
{
  std::vector<std::pair<std::string, double>> told;
  Pipeline pipeline(2);
  pipeline.setProgressSink([&](const std::string& stage, double fraction)
                           { told.emplace_back(stage, fraction); });
  const PipelineResult result = pipeline.run(light_field, options, {});
  for (const StageTime& time : result.stage_times)
  {
    EXPECT_TRUE(
        std::any_of(told.begin(), told.end(), [&](const auto& step) { return step.first == time.stage; }))
        << time.stage;
  }
  return told;
}

TEST(Pipeline, TellsTheProgressOfEveryMethod)
{
  const auto input = scene();
  for (const std::string& method : methodNames())
  {
    PipelineOptions options;
    options.method = methodFromString(method);
    const auto told = progressOf(input.light_field, options);
    ASSERT_FALSE(told.empty()) << method;
    EXPECT_EQ(told.front().second, 0.0) << method;
    double largest_step = 0.0;
    for (std::size_t i = 1; i < told.size(); ++i)
    {
      EXPECT_GE(told[i].second, told[i - 1].second) << method << ", " << told[i].first;
      largest_step = std::max(largest_step, told[i].second - told[i - 1].second);
    }
    EXPECT_LT(largest_step, 0.5) << method << ": no stage is half of the work";
    EXPECT_GT(told.back().second, 0.8) << method << ": what is last is near the end";
    EXPECT_LT(told.back().second, 1.0) << method;
  }
}

TEST(Pipeline, TellsTheProgressOfEachStageOfTheDefaultMethod)
{
  const auto told = progressOf(scene().light_field, {});
  for (std::size_t i = 1; i < told.size(); ++i)
  {
    // What runs in two parts, one after the other, counts once.
    EXPECT_TRUE(told[i].second > told[i - 1].second || told[i].first == told[i - 1].first)
        << told[i].first << " is not among the expected stages";
  }
}

TEST(Pipeline, NamesEveryOptionThatCannotBeUsed)
{
  PipelineOptions options;
  options.disparity_range = DisparityRange{2.0F, -1.0F};
  options.min_confidence = 3.0F;
  EXPECT_EQ(validate(options).size(), 2U);
  Pipeline pipeline(1);
  EXPECT_THROW(pipeline.run(scene().light_field, options, {}), InputError);
  EXPECT_THROW(methodFromString("magic"), InputError);
}

TEST(Pipeline, RefusesADisparityRangeInWhichNothingCanBeSeen)
{
  const LightField light_field = scene().light_field;
  const auto side = static_cast<float>(std::max(light_field.size().width, light_field.size().height));
  Pipeline pipeline(1);
  PipelineOptions options;
  for (const Method method : {Method::Multiview, Method::Paper2017})
  {
    options.method = method;
    for (const DisparityRange& range :
         {DisparityRange{-1e30F, 1e30F}, DisparityRange{0.0F, 1e10F}, DisparityRange{-1e9F, 0.0F},
          DisparityRange{2.0F * side, 3.0F * side}})
    {
      options.disparity_range = range;
      EXPECT_THROW(pipeline.run(light_field, options, {}), InputError) << range.min << ".." << range.max;
    }
    options.disparity_range = DisparityRange{-side, side};
    EXPECT_EQ(pipeline.run(light_field, options, {}).estimate.disparity.size(), light_field.size());
  }
}

/// Surfaces that go on beyond a range that is given end there, in the maps of all views.
TEST(Pipeline, KeepsTheMapsInARangeThatIsGiven)
{
  const auto input = scene();
  Pipeline pipeline(2);
  ProductRequest request;
  request.dense_cloud = true;
  PipelineOptions options;
  options.disparity_range = DisparityRange{-0.4F, 0.45F};  // of -1.2..2
  for (const Method method : {Method::Multiview, Method::Paper2017})
  {
    options.method = method;
    const DisparityEstimate estimate = pipeline.run(input.light_field, options, request).estimate;
    std::vector<cv::Mat> maps = {estimate.disparity};
    for (const ViewDisparity& view : estimate.view_disparities)
    {
      maps.push_back(view.disparity);
    }
    for (const cv::Mat& map : maps)
    {
      double min = 0.0;
      double max = 0.0;
      cv::minMaxLoc(map, &min, &max);
      EXPECT_GE(min, options.disparity_range->min) << toString(method);
      EXPECT_LE(max, options.disparity_range->max) << toString(method);
    }
  }
}

bool sameMaps(const cv::Mat& a, const cv::Mat& b)
{
  return a.size() == b.size() && std::equal(a.datastart, a.dataend, b.datastart, b.dataend);
}

TEST(Pipeline, MakesTheSameDenseCloudLater)
{
  auto input = scene();
  View& turned = input.light_field.views.front();
  cv::warpAffine(turned.image, turned.image, cv::Matx23d(1.0, 0.0, 1.5, 0.0, 1.0, 0.0), turned.image.size(),
                 cv::INTER_CUBIC, cv::BORDER_REPLICATE);  // a registration has to be handed on
  cv::Mat& mask = input.light_field.views.back().mask;
  mask = cv::Mat(input.truth.size(), CV_8UC1, cv::Scalar(255));
  mask({0, 0, 20, 96}).setTo(0);
  Pipeline pipeline(2);
  PipelineOptions options;
  options.dense_cloud.maps = 3;
  options.disparity_range = DisparityRange{-1.0F, 2.2F};
  options.max_depth_m = 2.3F;
  options.multiview.temporal = true;
  ProductRequest at_once;
  at_once.dense_cloud = true;
  ProductRequest later;
  later.dense_cloud_later = true;
  for (const Method method : {Method::Multiview, Method::Paper2017})
  {
    options.method = method;
    const std::vector<DensePoint> expected = Pipeline(1).run(input.light_field, options, at_once).dense_cloud;
    ASSERT_FALSE(expected.empty());
    const PipelineResult result = pipeline.run(input.light_field, options, later);
    EXPECT_TRUE(result.dense_cloud.empty());
    const cv::Mat before = result.estimate.disparity.clone();
    Pipeline apart(2);
    for (Pipeline* const other : {&apart, &pipeline})
    {
      std::vector<DensePoint> points;
      other->runDenseCloud(input.light_field, options, result.estimate,
                           [&](const DensePoint* block, std::size_t count)
                           { points.insert(points.end(), block, block + count); });
      ASSERT_EQ(points.size(), expected.size());
      EXPECT_EQ(std::memcmp(points.data(), expected.data(), points.size() * sizeof(DensePoint)), 0)
          << toString(method);
    }
    EXPECT_TRUE(sameMaps(result.estimate.disparity, before)) << "others read it meanwhile";
  }
}

/// What no view tells is known as filled, and is in no product but the map unless it is asked for.
TEST(Pipeline, KnowsWhatItFills)
{
  auto input = scene();
  const cv::Size size = input.truth.size();
  const cv::Rect blank(size.width / 2, 0, size.width - size.width / 2, size.height);
  for (View& view : input.light_field.views)
  {
    view.image = view.image.clone();
    view.image(blank).setTo(cv::Scalar::all(127));
  }
  Pipeline pipeline(2);
  ProductRequest request;
  request.depth = true;
  request.organized_cloud = true;
  PipelineOptions options;
  const PipelineResult seen = pipeline.run(input.light_field, options, request);
  const cv::Mat& filled = seen.estimate.filled;
  ASSERT_EQ(filled.size(), size);
  const double textured = static_cast<double>(size.area() - blank.area());
  const int filled_in_texture = cv::countNonZero(filled) - cv::countNonZero(filled(blank));
  std::cout << filled_in_texture / textured << " of what has texture counts as filled" << std::endl;
  EXPECT_GE(cv::countNonZero(filled(blank)), 0.98 * blank.area());
  EXPECT_LE(filled_in_texture, 0.05 * textured);
  EXPECT_EQ(cv::countNonZero(seen.depth(blank) == seen.depth(blank)),
            blank.area() - cv::countNonZero(filled(blank)));
  EXPECT_TRUE(std::isnan(seen.organized_cloud.back().z));
  options.keep_filled = true;
  const PipelineResult all = pipeline.run(input.light_field, options, request);
  EXPECT_EQ(cv::countNonZero(all.depth == all.depth), size.area());
  EXPECT_TRUE(std::isfinite(all.organized_cloud.back().z));
}

}  // namespace
}  // namespace light_field_depth
