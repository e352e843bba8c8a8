#include "core/preprocess/contrast_views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
LightField threeViews(const cv::Mat& image)
{
  LightField field = makeLightField({gridView(0, 0, image), gridView(0, 1, image), gridView(0, 2, image)});
  field.views[2].offset_px = {2.0, -1.0};
  return field;
}

cv::Mat texturedImage(const cv::Size& size)
{
  const testing::Texture texture = testing::noiseTexture(7, 12.0);
  cv::Mat image(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(0.5 * texture(x, y)[0] + 40.0);
    }
  }
  return image;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b)
{
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

TEST(ContrastViews, TheLongerSideHasAtLeast96Pixels)
{
  EXPECT_EQ(contrastReduction({80, 60}), 1);
  EXPECT_EQ(contrastReduction({192, 100}), 2);
  EXPECT_EQ(contrastReduction({512, 512}), 4);
}

TEST(ContrastViews, StepsAndOffsetsShrinkWithTheImages)
{
  ThreadPool pool(1);
  const LightField field = threeViews(texturedImage({192, 144}));
  const std::vector<ContrastView> views = contrastViews(field, {2, 0}, pool);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].index, 2U);
  EXPECT_EQ(views[0].image.size(), cv::Size(96, 72));
  EXPECT_EQ(views[0].steps, cv::Point2f(0.5F, 0.0F));
  EXPECT_EQ(views[0].offset, cv::Point2f(1.0F, -0.5F));
  EXPECT_EQ(views[1].steps, cv::Point2f(-0.5F, 0.0F));
}

TEST(ContrastViews, AnOffsetChangesNothingAndAGainLittle)
{
  ThreadPool pool(1);
  const cv::Mat image = texturedImage({128, 96});
  LightField field = threeViews(image);
  image.convertTo(field.views[0].image, CV_8U, 1.0, 30.0);
  image.convertTo(field.views[2].image, CV_8U, 0.6, 10.0);
  const std::vector<ContrastView> views = contrastViews(field, {1, 0, 2}, pool);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(views[0].image, mean, deviation);
  EXPECT_NEAR(mean[0], 0.0, 0.05);
  EXPECT_GT(deviation[0], 0.6);
  EXPECT_LT(deviation[0], 1.1);
  EXPECT_LT(meanDifference(views[0].image, views[1].image), 1e-4);
  // 0.6 levels of detail over 0.6 levels of contrast and the 2 that count half.
  const double product = views[0].image.dot(views[2].image);
  EXPECT_GT(product / (cv::norm(views[0].image) * cv::norm(views[2].image)), 0.99);
}

TEST(ContrastViews, SixteenBitsAreStretchedToWhatTheReferenceSpans)
{
  ThreadPool pool(1);
  const cv::Mat image = texturedImage({128, 96});
  cv::Mat deep;
  image.convertTo(deep, CV_16U, 16.0, 3000.0);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxIdx(image, &least, &most);
  cv::Mat stretched;
  image.convertTo(stretched, CV_8U, 255.0 / (most - least), -least * 255.0 / (most - least));
  const cv::Mat expected = contrastViews(threeViews(stretched), {1}, pool)[0].image;
  EXPECT_LT(meanDifference(contrastViews(threeViews(deep), {1}, pool)[0].image, expected), 0.02);
}

TEST(ContrastViews, AFlatImageHasNoContrast)
{
  ThreadPool pool(1);
  const cv::Mat flat(96, 128, CV_8UC1, cv::Scalar(90));
  EXPECT_LT(cv::norm(contrastViews(threeViews(flat), {0}, pool)[0].image, cv::NORM_INF), 1e-4);
}

TEST(ContrastViews, TheOffsetIsTakenBack)
{
  ContrastView view;
  view.image = cv::Mat::zeros(5, 6, CV_32FC1);
  view.image.at<float>(1, 4) = 3.0F;
  EXPECT_EQ(shiftedBack(view).data, view.image.data);
  view.offset = {2.0F, -1.0F};
  const cv::Mat back = shiftedBack(view);
  EXPECT_FLOAT_EQ(back.at<float>(2, 2), 3.0F);
  EXPECT_DOUBLE_EQ(cv::sum(back)[0], 3.0);
}

TEST(ContrastViews, SamplesBetweenFourPixelsAndNotOutside)
{
  const cv::Mat image = (cv::Mat_<float>(2, 3) << 0.0F, 4.0F, 8.0F, 2.0F, 6.0F, 10.0F);
  float value = 0.0F;
  EXPECT_TRUE(sampleContrast(image, 0.25F, 0.5F, value));
  EXPECT_FLOAT_EQ(value, 2.0F);
  EXPECT_FALSE(sampleContrast(image, -0.1F, 0.5F, value));
  EXPECT_FALSE(sampleContrast(image, 2.1F, 0.5F, value));
  EXPECT_FALSE(sampleContrast(image, 0.5F, 1.0F, value)) << "there is no row below";
}

}  // namespace
}  // namespace light_field_depth
