#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/registration.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
LightField crossOfFive()
{
  testing::SceneSettings settings;
  settings.size = cv::Size(96, 72);
  settings.positions = testing::crossPositions(3, 3);
  return testing::renderScene(testing::standardScene(settings.size), settings).light_field;
}

std::size_t firstButReference(const LightField& light_field)
{
  return light_field.reference_index == 0 ? 1 : 0;
}

TEST(RegisteredViews, StepsAndOffsetsFollowTheLineBetweenRowsAndColumns)
{
  const LightField light_field = crossOfFive();
  Registration registration;
  registration.differs = true;
  registration.step_ratio = 1.1;
  registration.step_offset_px = 0.2;
  registration.row_offset_px = -0.1;
  ThreadPool pool(1);
  const LightField corrected = correctRegistration(light_field, registration, pool);
  for (std::size_t i = 0; i < corrected.views.size(); ++i)
  {
    const View& before = light_field.views[i];
    const View& after = corrected.views[i];
    // Where disparity 2 of the result is seen: as 2 - 0.1 by the row, and as 1.1 * 1.9 + 0.2 by the column.
    const cv::Point2d place = after.offset_px - 2.0 * after.steps;
    EXPECT_NEAR(place.x, before.offset_px.x - 1.9 * before.steps.x, 1e-12);
    EXPECT_NEAR(place.y, before.offset_px.y - 2.29 * before.steps.y, 1e-12);
    EXPECT_EQ(after.image.data, before.image.data);
  }
}

TEST(RegisteredViews, OnlyViewsWithAMisfitAreResampled)
{
  LightField light_field = crossOfFive();
  const std::size_t moved = firstButReference(light_field);
  View& view = light_field.views[moved];
  view.mask = cv::Mat(view.image.size(), CV_8UC1, cv::Scalar(255));
  view.mask.colRange(0, 10).setTo(0);
  Registration registration;
  registration.differs = true;
  registration.resample = true;
  registration.views.resize(light_field.views.size());
  registration.views[moved].shift_px = {3.0, 0.0};
  ThreadPool pool(2);
  const LightField corrected = correctRegistration(light_field, registration, pool);
  for (std::size_t i = 0; i < corrected.views.size(); ++i)
  {
    EXPECT_EQ(corrected.views[i].image.data == light_field.views[i].image.data, i != moved);
  }
  const cv::Rect left(0, 0, view.image.cols - 3, view.image.rows);
  const cv::Rect right(3, 0, view.image.cols - 3, view.image.rows);
  EXPECT_EQ(cv::norm(corrected.views[moved].image(left), view.image(right), cv::NORM_INF), 0.0);
  // Known is what was made of known pixels alone, of two to each side.
  EXPECT_EQ(corrected.views[moved].mask.at<std::uint8_t>(20, 6), 0);
  EXPECT_NE(corrected.views[moved].mask.at<std::uint8_t>(20, 12), 0);
}

TEST(RegisteredViews, WhatIsNotKnownOfIsLeftOut)
{
  const LightField light_field = crossOfFive();
  ThreadPool pool(1);
  EXPECT_EQ(registeredViews(light_field, {}, pool).views.size(), light_field.views.size());
  Registration registration;
  registration.differs = true;
  registration.views.resize(light_field.views.size());
  const std::size_t moved = firstButReference(light_field);
  registration.views[moved].shift_px = {0.25, -0.5};
  const LightField known = registeredViews(light_field, registration, pool);
  ASSERT_EQ(known.views.size(), 2U);
  EXPECT_EQ(known.reference().grid, light_field.reference().grid);
  EXPECT_EQ(known.views[1 - known.reference_index].offset_px,
            light_field.views[moved].offset_px + cv::Point2d(0.25, -0.5));
}

}  // namespace
}  // namespace light_field_depth
