#include "ros/light_field_assembler.h"

#include <utility>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>

#include "expect_sentence.h"
#include "light_field_depth/ros/view_messages.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

/// The messages of a 3 x 3 array, some of which the tests spoil.
struct Messages
{
  ViewArray array;
  std::vector<sensor_msgs::ImagePtr> images;
  std::vector<sensor_msgs::CameraInfoPtr> infos;
};

Messages messages()
{
  Calibration calibration;
  calibration.focal_length_px = 50.0;
  calibration.principal_point_px = {19.5, 15.5};
  calibration.baseline_m = 0.1;
  calibration.disparity_offset_px = 4.0;
  testing::SceneSettings settings;
  settings.size = {40, 32};
  settings.positions = testing::gridPositions(3, 3);
  settings.calibration = calibration;
  const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
  Messages result;
  for (const ViewMessages& view : viewMessages(scene.light_field, calibration, {}))
  {
    result.images.push_back(view.image);
    result.infos.push_back(view.camera_info);
  }
  for (const View& view : scene.light_field.views)
  {
    result.array.views.push_back({view.grid, "image" + std::to_string(result.array.views.size()), "info"});
  }
  result.array.reference = 4;
  return result;
}

LightField assemble(LightFieldAssembler& assembler, const Messages& input)
{
  return assembler.assemble({input.images.begin(), input.images.end()},
                            {input.infos.begin(), input.infos.end()});
}

ThreadPool& pool()
{
  static ThreadPool threads(2);
  return threads;
}

LightFieldAssembler assemblerFor(const Messages& input, const AssemblerOptions& options = {})
{
  return {input.array, {}, options, pool()};
}

TEST(LightFieldAssembler, MakesTheLightFieldThatWasPublished)
{
  const Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  const LightField light_field = assemble(assembler, input);
  ASSERT_EQ(light_field.views.size(), 9U);
  EXPECT_EQ(light_field.reference_index, 4U);
  ASSERT_TRUE(light_field.calibration);
  EXPECT_NEAR(light_field.calibration->disparity_offset_px, 4.0, 1e-9);
  EXPECT_NEAR(light_field.views[8].steps.x, 1.0, 1e-9);
  EXPECT_EQ(light_field.views[2].image.data, input.images[2]->data.data()) << "nothing is copied";
}

TEST(LightFieldAssembler, FollowsACameraInfoThatChanges)
{
  Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  assemble(assembler, input);
  for (auto& info : input.infos)
  {
    info = boost::make_shared<sensor_msgs::CameraInfo>(*info);
    info->P[3] *= 2.0;
    info->P[7] *= 2.0;
  }
  EXPECT_NEAR(assemble(assembler, input).calibration->baseline_m, 0.2, 1e-9);
}

TEST(LightFieldAssembler, RecoversFromABadFrame)
{
  Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  const double focal_length = input.infos[5]->P[0];
  input.infos[5]->P[0] = 0.0;
  expectSentence([&] { assemble(assembler, input); }, {"View (1, 2)", "P[0]"});
  input.infos[5]->P[0] = focal_length;
  EXPECT_EQ(assemble(assembler, input).views.size(), 9U);
}

TEST(LightFieldAssembler, NamesTheViewWhoseCameraInfoHasBeenForgotten)
{
  Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  const auto info = std::exchange(input.infos[3], nullptr);
  const auto assemble_all = [&] { assemble(assembler, input); };
  expectSentence(assemble_all, {"View (1, 0) (image3)", "no CameraInfo", "'info'"});
  input.infos[3] = info;
  assemble(assembler, input);
  input.infos[3] = nullptr;  // between two sets, as a reset may do
  expectSentence(assemble_all, {"View (1, 0) (image3)", "no CameraInfo", "'info'"});
}

TEST(LightFieldAssembler, NamesTheViewWhoseImageDoesNotFit)
{
  Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  input.infos[0]->width = 80;
  for (auto& info : input.infos)
  {
    info->width = 80;
  }
  expectSentence([&] { assemble(assembler, input); }, {"View (0, 0) (image0)", "40 x 32", "80 x 32"});

  Messages mixed = messages();
  LightFieldAssembler mixed_assembler = assemblerFor(mixed);
  mixed.images[7]->encoding = "mono8";
  mixed.images[7]->step = 40;
  expectSentence([&] { assemble(mixed_assembler, mixed); }, {"View (2, 1)", "8-bit with 1 channel"});
}

TEST(LightFieldAssembler, TakesParametersInPlaceOfCameraInfo)
{
  const Messages input = messages();
  CalibrationParameters parameters;
  parameters.focal_length_px = 70.0;
  parameters.baseline_x_m = 0.3;
  AssemblerOptions options;
  options.use_camera_info = false;
  LightFieldAssembler assembler(input.array, parameters, options, pool());
  const LightField light_field = assembler.assemble({input.images.begin(), input.images.end()}, {});
  EXPECT_DOUBLE_EQ(light_field.calibration->baseline_m, 0.3);
}

TEST(LightFieldAssembler, GoesOnWithoutAViewThatIsMissing)
{
  Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  const LightField whole = assemble(assembler, input);
  input.images[0] = nullptr;
  const LightField partial = assemble(assembler, input);
  ASSERT_EQ(partial.views.size(), 8U);
  EXPECT_EQ(partial.reference().grid, whole.reference().grid);
  EXPECT_EQ(partial.views[7].steps, whole.views[8].steps);
  input.images[4] = nullptr;
  expectSentence([&] { assemble(assembler, input); }, {"View (1, 1)", "reference"});
}

TEST(LightFieldAssembler, ReducesViewsAndTheirCalibration)
{
  const Messages input = messages();
  AssemblerOptions options;
  options.decimation = 2;
  LightFieldAssembler assembler = assemblerFor(input, options);
  const LightField light_field = assemble(assembler, input);
  EXPECT_EQ(light_field.size(), cv::Size(20, 16));
  EXPECT_NEAR(light_field.calibration->focal_length_px, 25.0, 1e-9);
  EXPECT_NEAR(light_field.calibration->disparity_offset_px, 2.0, 1e-9);
  EXPECT_NEAR(light_field.calibration->principal_point_px.x, (19.5 + 0.5) / 2 - 0.5, 1e-9);
  EXPECT_NEAR(light_field.calibration->baseline_m, 0.1, 1e-9);
  EXPECT_EQ(assembler.referenceInfo().width, 20U);
}

TEST(LightFieldAssembler, DecodesCompressedImages)
{
  const Messages input = messages();
  LightFieldAssembler assembler = assemblerFor(input);
  const LightField raw = assemble(assembler, input);
  std::vector<ViewImage> compressed;
  for (const View& view : raw.views)
  {
    const auto message = boost::make_shared<sensor_msgs::CompressedImage>();
    message->format = "bgr8; png compressed bgr8";
    cv::imencode(".png", view.image, message->data);
    compressed.emplace_back(sensor_msgs::CompressedImageConstPtr(message));
  }
  const LightField decoded = assembler.assemble(compressed, {input.infos.begin(), input.infos.end()});
  EXPECT_EQ(cv::norm(decoded.views[3].image, raw.views[3].image, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth
