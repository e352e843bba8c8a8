#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/preprocess/even_exposure.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(EvenExposure, IsAMeanBrightnessAndWhatParallaxAdds)
{
  testing::SceneSettings settings;
  settings.grey = true;
  settings.positions = testing::crossPositions(5, 5);
  auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  EXPECT_TRUE(looksEvenlyExposed(input.light_field));
  cv::Mat& image = input.light_field.views.front().image;
  image.convertTo(image, -1, 1.05, 0.0);
  EXPECT_FALSE(looksEvenlyExposed(input.light_field));
}

}  // namespace
}  // namespace light_field_depth::multiview
