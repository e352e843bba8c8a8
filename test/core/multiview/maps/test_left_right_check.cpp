#include "core/multiview/maps/left_right_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
constexpr float WALL = 2.0F;
constexpr float BOX = 10.0F;
const cv::Size SIZE(96, 64);
const cv::Rect BOX_AREA(40, 16, 24, 32);

cv::Mat leftMap()
{
  cv::Mat map(SIZE, CV_32FC1, cv::Scalar(WALL));
  map(BOX_AREA).setTo(BOX);
  return map;
}

/// As the right view sees it, a point of disparity d at x - d.
cv::Mat rightMap()
{
  cv::Mat map(SIZE, CV_32FC1, cv::Scalar(WALL));
  map(BOX_AREA - cv::Point(static_cast<int>(BOX), 0)).setTo(BOX);
  return map;
}

/// What the right view cannot see: a strip as wide as the change of disparity beside the box, and one that
/// has left its image.
cv::Mat hidden()
{
  cv::Mat mask = cv::Mat::zeros(SIZE, CV_8UC1);
  constexpr int strip = static_cast<int>(BOX - WALL);
  mask(cv::Rect(BOX_AREA.x - strip, BOX_AREA.y, strip, BOX_AREA.height)).setTo(255);
  mask.colRange(0, static_cast<int>(WALL)).setTo(255);
  return mask;
}

View rightView()
{
  View view;
  view.steps = {1.0, 0.0};
  return view;
}

int disagreements(const cv::Mat& a, const cv::Mat& b)
{
  return cv::countNonZero(a != b);
}

TEST(LeftRightCheck, MarksWhatTheOtherViewCannotSee)
{
  ThreadPool pool(2);
  EXPECT_EQ(disagreements(findUnconfirmed(leftMap(), rightView(), rightMap(), {}, pool), hidden()), 0);
}

TEST(LeftRightCheck, TakesAMapOfHalfTheSize)
{
  cv::Mat half;
  cv::resize(rightMap(), half, {}, 0.5, 0.5, cv::INTER_NEAREST);
  ThreadPool pool(2);
  const cv::Mat marked = findUnconfirmed(leftMap(), rightView(), half, {}, pool);
  EXPECT_LE(disagreements(marked, hidden()), 2 * BOX_AREA.height);
}

TEST(LeftRightCheck, IsMeasuredInPixelsOfDisplacement)
{
  // The same displacements in a wider unit of disparity.
  constexpr double UNIT = 4.0;
  View other = rightView();
  other.steps *= UNIT;
  ThreadPool pool(2);
  const cv::Mat marked = findUnconfirmed(leftMap() / UNIT, other, rightMap() / UNIT, {}, pool);
  EXPECT_EQ(disagreements(marked, hidden()), 0);
}

TEST(LeftRightCheck, DoesNotBelieveSmallRegions)
{
  // Both maps agree on a patch of 6 x 6 pixels, as repeated texture makes them.
  constexpr float CHANCE = 6.0F;
  const cv::Rect patch(80, 20, 6, 6);
  cv::Mat left = leftMap();
  cv::Mat right = rightMap();
  left(patch).setTo(CHANCE);
  right(patch - cv::Point(static_cast<int>(CHANCE), 0)).setTo(CHANCE);
  ThreadPool pool(2);
  LeftRightSettings settings;
  EXPECT_EQ(cv::countNonZero(findUnconfirmed(left, rightView(), right, settings, pool)(patch)), patch.area());
  settings.min_region_px = patch.area();
  EXPECT_EQ(cv::countNonZero(findUnconfirmed(left, rightView(), right, settings, pool)(patch)), 0);
}

TEST(BackgroundFill, TakesTheFartherSide)
{
  cv::Mat image(SIZE, CV_8UC3, cv::Scalar(40, 90, 60));
  image(BOX_AREA).setTo(cv::Scalar(200, 60, 180));
  cv::Mat map = leftMap();
  map.setTo(BOX, hidden());  // the foreground has spread
  ThreadPool pool(2);
  fillFromBackground(image, hidden(), false, {}, pool, map);
  EXPECT_EQ(disagreements(map, leftMap()), 0);
}

TEST(BackgroundFill, FillsColumnsAsRows)
{
  cv::Mat image(SIZE, CV_8UC1);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::Mat map = leftMap();
  cv::Mat noise(SIZE, CV_32FC1);
  random.fill(noise, cv::RNG::UNIFORM, -0.4, 0.4);
  map += noise;
  cv::Mat turned = map.t();
  ThreadPool pool(2);
  fillFromBackground(image, hidden(), false, {}, pool, map);
  fillFromBackground(image.t(), hidden().t(), true, {}, pool, turned);
  EXPECT_EQ(disagreements(map, turned.t()), 0);
}

/// The weighted median about a pixel, by sorting all samples.
float medianBySorting(const cv::Mat& image, const cv::Mat& map, const cv::Point& at,
                      const BackgroundFillSettings& settings)
{
  std::vector<std::pair<float, float>> samples;
  double total = 0.0;
  for (int y = at.y - settings.radius_px; y <= at.y + settings.radius_px; y += settings.stride_px)
  {
    for (int x = at.x - settings.radius_px; x <= at.x + settings.radius_px; x += settings.stride_px)
    {
      if (cv::Rect({}, map.size()).contains({x, y}))
      {
        const auto here = image.at<cv::Vec3b>(at);
        const auto there = image.at<cv::Vec3b>(y, x);
        const double difference = cv::norm(cv::Vec3i(here) - cv::Vec3i(there), cv::NORM_L1) / 3.0;
        const auto weight = static_cast<float>(std::exp(-difference / settings.colour_scale));
        samples.emplace_back(map.at<float>(y, x), weight);
        total += weight;
      }
    }
  }
  std::sort(samples.begin(), samples.end());
  double sum = 0.0;
  for (const auto& [value, weight] : samples)
  {
    sum += weight;
    if (sum >= 0.5 * total)
    {
      return value;
    }
  }
  return samples.back().first;
}

TEST(BackgroundFill, TakesTheMedianOfWhatHasTheSameColour)
{
  cv::RNG random(11);
  cv::Mat image(SIZE, CV_8UC3);
  random.fill(image, cv::RNG::UNIFORM, 90, 130);
  cv::Mat map(SIZE, CV_32FC1);
  random.fill(map, cv::RNG::UNIFORM, 0.0, 20.0);
  map.colRange(0, 48).forEach<float>([](float& value, const int*) { value = std::round(value / 4.0F); });
  cv::Mat marked = cv::Mat::zeros(SIZE, CV_8UC1);
  std::vector<cv::Point> pixels;
  for (int y = 1; y < SIZE.height; y += 7)
  {
    for (int x = 1; x < SIZE.width; x += 5)
    {
      pixels.emplace_back(x, y);
      marked.at<std::uint8_t>(y, x) = 255;
    }
  }
  cv::Mat before = map.clone();  // as it is when rows are filled
  for (const cv::Point& at : pixels)
  {
    const cv::Point left = at - cv::Point(1, 0);
    const float right = at.x + 1 < SIZE.width ? map.at<float>(at + cv::Point(1, 0)) : map.at<float>(left);
    before.at<float>(at) = std::min(map.at<float>(left), right);
  }
  BackgroundFillSettings coarse;
  coarse.radius_px = 8;
  coarse.stride_px = 4;
  ThreadPool pool(2);
  for (const BackgroundFillSettings& settings : {BackgroundFillSettings(), coarse})
  {
    cv::Mat filled = map.clone();
    fillFromBackground(image, marked, false, settings, pool, filled);
    for (const cv::Point& at : pixels)
    {
      EXPECT_EQ(filled.at<float>(at), medianBySorting(image, before, at, settings)) << at;
    }
  }
}

TEST(BackgroundFill, EverySecondPixelMayTakeTheMedianOfAnEqualNeighbour)
{
  ThreadPool pool(2);
  BackgroundFillSettings settings;
  settings.max_colour_step = 8;
  cv::Mat image(SIZE, CV_8UC3, cv::Scalar(90, 90, 90));
  for (int x = 0; x < SIZE.width; ++x)
  {
    image.col(x).setTo(cv::Scalar::all(x % 4 < 2 ? 90 : 190));  // stripes: copies end where colours change
  }
  cv::Mat before = leftMap().clone();
  cv::RNG random(3);
  random.fill(before, cv::RNG::UNIFORM, 0.0F, 4.0F);
  const cv::Mat marked(hidden());
  cv::Mat every = before.clone();
  cv::Mat some = before.clone();
  fillFromBackground(image, marked, false, {}, pool, every);
  fillFromBackground(image, marked, false, settings, pool, some);
  int copied = 0;
  for (int y = 0; y < SIZE.height; ++y)
  {
    for (int x = 0; x < SIZE.width; ++x)
    {
      const bool is_copy = some.at<float>(y, x) != every.at<float>(y, x);
      copied += is_copy ? 1 : 0;
      EXPECT_TRUE(!is_copy || (marked.at<std::uint8_t>(y, x) != 0 && (x % 2 == 1 || y % 2 == 1)))
          << x << " " << y;
    }
  }
  EXPECT_GT(copied, 0);
}

TEST(BackgroundFill, ReachesRowsWithoutAnyValueAndLeavesAMapWithoutAnyAsItIs)
{
  const cv::Mat image(SIZE, CV_8UC1, cv::Scalar(80));
  cv::Mat marked = hidden();
  marked.rowRange(0, 5).setTo(255);
  cv::Mat map(SIZE, CV_32FC1, cv::Scalar(WALL));
  map.setTo(BOX, marked);
  ThreadPool pool(2);
  fillFromBackground(image, marked, false, {}, pool, map);
  EXPECT_EQ(cv::norm(map, cv::Mat(SIZE, CV_32FC1, cv::Scalar(WALL)), cv::NORM_INF), 0.0);

  const cv::Mat all(SIZE, CV_8UC1, cv::Scalar(255));
  cv::Mat unknown(SIZE, CV_32FC1, cv::Scalar(BOX));
  fillFromBackground(image, all, false, {}, pool, unknown);
  EXPECT_EQ(cv::norm(unknown, cv::Mat(SIZE, CV_32FC1, cv::Scalar(BOX)), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
