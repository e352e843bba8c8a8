#include "camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::benchmark
{
namespace
{
/// Nothing but what is switched on afterwards.
CameraModel perfectCamera()
{
  CameraModel model;
  model.shift_px = 0.0;
  model.roll_degrees = 0.0;
  model.blur_px = 0.0;
  model.gain = 0.0;
  model.full_well = 0.0;
  model.mosaic = false;
  model.jpeg_quality = 0;
  return model;
}

/// The same picture in 25 views.
LightField sameViews(const cv::Mat& image)
{
  std::vector<View> views;
  for (const GridPosition& position : testing::gridPositions(5, 5))
  {
    views.push_back(gridView(position.row, position.column, image));
  }
  return makeLightField(std::move(views));
}

cv::Mat texture(const cv::Size& size)
{
  testing::SceneSettings settings;
  settings.size = size;
  settings.positions = testing::gridPositions(1, 2);
  return testing::renderScene({testing::plane(0.0, 0, 0, testing::noiseTexture(5, 24.0))}, settings)
      .light_field.reference()
      .image;
}

double rootMeanSquare(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Calls with every view but the reference.
template <class Action>
std::vector<double> ofOtherViews(const LightField& light_field, const Action& action)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i != light_field.reference_index)
    {
      values.push_back(action(light_field.views[i].image));
    }
  }
  return values;
}

TEST(CameraModel, APerfectCameraChangesNothing)
{
  const cv::Mat image = texture({64, 48});
  const LightField taken = photograph(sameViews(image), perfectCamera());
  for (const View& view : taken.views)
  {
    EXPECT_EQ(cv::norm(view.image, image, cv::NORM_INF), 0.0);
  }
}

TEST(CameraModel, TheReferenceStaysInPlaceAndHasTheGainOne)
{
  CameraModel model = perfectCamera();
  model.shift_px = 0.5;
  model.roll_degrees = 1.0;
  model.gain = 0.2;
  const cv::Mat image = texture({64, 48});
  const LightField taken = photograph(sameViews(image), model);
  EXPECT_EQ(cv::norm(taken.reference().image, image, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(taken.views.front().image, image, cv::NORM_INF), 10.0);
}

TEST(CameraModel, TakesTheSamePictureInEveryRunAndAnotherWithAnotherSeed)
{
  const LightField views = sameViews(texture({64, 48}));
  CameraModel model;
  const LightField taken = photograph(views, model);
  const LightField cross = photograph(selectViews(views, ViewSelection::Cross), model);
  EXPECT_EQ(cv::norm(taken.views[2].image, cross.views[0].image, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(taken.views[2].image, taken.views[3].image, cv::NORM_INF), 0.0);
  model.seed = 8;
  EXPECT_GT(cv::norm(taken.views[2].image, photograph(views, model).views[2].image, cv::NORM_INF), 0.0);
}

TEST(CameraModel, ShiftsAreOfTheStatedSize)
{
  CameraModel model = perfectCamera();
  model.shift_px = 0.3;
  const cv::Mat image = texture({96, 96});
  cv::Mat expected;
  toGrey(image).convertTo(expected, CV_32F);
  const LightField taken = photograph(sameViews(image), model);
  const auto shift = [&](const cv::Mat& moved)
  {
    cv::Mat values;
    toGrey(moved).convertTo(values, CV_32F);
    cv::Mat window;
    cv::createHanningWindow(window, values.size(), CV_32F);
    const cv::Point2d found = cv::phaseCorrelate(expected, values, window);
    return std::hypot(found.x, found.y) / std::sqrt(2.0);
  };
  // 48 random numbers: a tenth of the figure is their standard error.
  EXPECT_NEAR(rootMeanSquare(ofOtherViews(taken, shift)), 0.3, 0.1);
}

TEST(CameraModel, GainsAreOfLight)
{
  CameraModel model = perfectCamera();
  model.gain = 0.1;
  const int level = 128;
  const LightField taken = photograph(sameViews(cv::Mat(32, 32, CV_8UC3, cv::Scalar::all(level))), model);
  // At this level a change of light by 1 % is one of 0.53 levels.
  const auto change = [&](const cv::Mat& image) { return cv::mean(image)[0] - level; };
  EXPECT_NEAR(rootMeanSquare(ofOtherViews(taken, change)), 5.3, 2.0);
}

TEST(CameraModel, NoiseIsThatOfPhotonsAndOfReading)
{
  CameraModel model = perfectCamera();
  model.full_well = 8000.0;
  model.read_noise = 6.0;
  for (const int level : {30, 128, 220})
  {
    const LightField taken = photograph(sameViews(cv::Mat(64, 64, CV_8UC1, cv::Scalar(level))), model);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(taken.reference().image, mean, deviation);
    const double light = std::pow((level / 255.0 + 0.055) / 1.055, 2.4);
    const double slope =
        255.0 * 1.055 / 2.4 * std::pow(light, 1.0 / 2.4 - 1.0);  // levels for a unit of light
    const double noise = slope * std::sqrt(8000.0 * light + 36.0) / 8000.0;
    const double rounding = 1.0 / 12.0;
    EXPECT_NEAR(mean[0], level, 0.2);
    EXPECT_NEAR(deviation[0], std::sqrt(noise * noise + rounding), 0.05 * noise + 0.03) << level;
  }
}

TEST(CameraModel, MosaicAndCompressionCorrelateTheNoise)
{
  const LightField views = sameViews(cv::Mat(96, 96, CV_8UC3, cv::Scalar::all(128)));
  const auto ofNeighbours = [&](const CameraModel& model)
  {
    cv::Mat grey;
    toGrey(photograph(views, model).reference().image).convertTo(grey, CV_32F);
    grey -= cv::mean(grey);
    const int right = grey.cols - 1;
    return grey.colRange(0, right).dot(grey.colRange(1, right + 1)) / grey.dot(grey);
  };
  CameraModel model = perfectCamera();
  model.full_well = 8000.0;
  EXPECT_NEAR(ofNeighbours(model), 0.0, 0.05);
  model.mosaic = true;
  EXPECT_GT(ofNeighbours(model), 0.2);
  model.jpeg_quality = 90;
  EXPECT_GT(ofNeighbours(model), 0.2);
}

TEST(CameraModel, GreyViewsStayGrey)
{
  const LightField taken = photograph(sameViews(toGrey(texture({64, 48}))));
  EXPECT_EQ(taken.reference().image.type(), CV_8UC1);
}

TEST(CameraModel, RefusesViewsOfSixteenBits)
{
  EXPECT_THROW(photograph(sameViews(cv::Mat(32, 32, CV_16UC1, cv::Scalar(100)))), InputError);
}

}  // namespace
}  // namespace light_field_depth::benchmark
