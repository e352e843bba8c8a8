#include <gtest/gtest.h>

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

}  // namespace
}  // namespace light_field_depth
