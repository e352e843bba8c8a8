#include "core/preprocess/plane_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "support/instruction_sets.h"

namespace light_field_depth
{
namespace
{
cv::Mat randomBytes(cv::RNG& random, const cv::Size& size)
{
  cv::Mat image(size, CV_8UC1);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

int blend(int a, int b, int fraction)
{
  return (a * (32 - fraction) + b * fraction + 16) / 32;
}

/// The value of a view between its pixels in 32nds, rounded after each direction.
int sample(const cv::Mat& image, int x, int y, int fraction_x, int fraction_y)
{
  const auto column = [&](int at)
  {
    const int here = image.at<std::uint8_t>(y, at);
    return fraction_y == 0 ? here : blend(here, image.at<std::uint8_t>(y + 1, at), fraction_y);
  };
  return fraction_x == 0 ? column(x) : blend(column(x), column(x + 1), fraction_x);
}

int differenceAt(const cv::Mat& reference, const SweepView& view, float disparity, int x, int y)
{
  const auto seen_x = static_cast<int>(std::lround(32 * (view.offset.x - disparity * view.steps.x))) + 32 * x;
  const auto seen_y = static_cast<int>(std::lround(32 * (view.offset.y - disparity * view.steps.y))) + 32 * y;
  if (seen_x < 0 || seen_y < 0 || seen_x > 32 * (reference.cols - 1) || seen_y > 32 * (reference.rows - 1))
  {
    return SWEEP_TRUNCATION;
  }
  const int value = sample(view.image, seen_x / 32, seen_y / 32, seen_x % 32, seen_y % 32);
  return std::min<int>(std::abs(value - reference.at<std::uint8_t>(y, x)), SWEEP_TRUNCATION);
}

/// What one arm adds to the cost, by its definition.
int armCost(const cv::Mat& reference, const SweepArm& arm, float disparity, int x, int y)
{
  int sum = 0;
  for (int dy = -2; dy <= 2; ++dy)
  {
    for (int dx = -2; dx <= 2; ++dx)
    {
      for (const SweepView& view : arm)
      {
        sum += differenceAt(reference, view, disparity, std::clamp(x + dx, 0, reference.cols - 1),
                            std::clamp(y + dy, 0, reference.rows - 1));
      }
    }
  }
  const int factor = SWEEP_COST_PER_GREY_LEVEL * 65536 / (25 * static_cast<int>(arm.size()));
  return static_cast<int>(static_cast<std::int64_t>(sum) * factor / 65536);
}

int costAt(const PlaneSweep& sweep, int label, int x, int y)
{
  int total = 0;
  int worst = 0;
  for (const SweepArm& arm : sweep.arms)
  {
    const int cost = armCost(sweep.reference, arm, sweep.disparity(static_cast<float>(label)), x, y);
    total += cost;
    worst = std::max(worst, cost);
  }
  const auto arms = static_cast<int>(sweep.arms.size());
  return arms == 1 ? total : (total - worst) / (arms - 1);
}

class PlaneSweeps : public testing::InstructionSetTest
{
};

TEST_P(PlaneSweeps, HaveCostsAsDefined)
{
  const cv::Size size(75, 20);  // wider than whole vectors
  cv::RNG random(3);
  for (std::size_t arms = 1; arms <= 4; ++arms)
  {
    PlaneSweep sweep;
    sweep.reference = randomBytes(random, size);
    for (std::size_t arm = 0; arm < arms; ++arm)
    {
      const float far = arm % 2 == 0 ? 1.0F : -1.0F;
      const cv::Point2f steps = arm < 2 ? cv::Point2f(far, 0.1F) : cv::Point2f(0.0F, far);
      sweep.arms.push_back({{randomBytes(random, size), steps, {0.3F, -0.2F}},
                            {randomBytes(random, size), 2.0F * steps, {}},
                            {randomBytes(random, size), 4.0F * steps, {}}});
    }
    sweep.first_disparity = -21.0F;
    sweep.disparity_step = 3.3F;
    sweep.labels = 13;
    ThreadPool pool(2);
    const SweepCosts volume = sweepPlanes(sweep, pool);
    for (int label = 0; label < sweep.labels; ++label)
    {
      for (int pixel = 0; pixel < size.area(); ++pixel)
      {
        ASSERT_EQ(volume.cost(label)[pixel], costAt(sweep, label, pixel % size.width, pixel / size.width))
            << arms << " arms, label " << label << ", pixel " << pixel;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, PlaneSweeps, testing::everyInstructionSet(),
                         testing::instructionSetName);

}  // namespace
}  // namespace light_field_depth
