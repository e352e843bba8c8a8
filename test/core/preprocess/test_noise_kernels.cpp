#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/preprocess/noise_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth
{
namespace
{
class NoiseKernels : public testing::InstructionSetTest
{
};

TEST_P(NoiseKernels, SumTheResponsesOfTheMask)
{
  constexpr int TOP = 2;
  constexpr int BOTTOM = 10;
  for (const int width : {6, 75})
  {
    for (const int channels : {1, 3})
    {
      cv::Mat image(12, width * channels, CV_8UC1);
      cv::RNG random(8);
      random.fill(image, cv::RNG::UNIFORM, 0, 256);
      std::vector<std::uint16_t> response(image.cols);
      std::vector<std::uint16_t> level(image.cols);
      sumMaskResponses(image.reshape(channels), TOP, BOTTOM, response.data(), level.data());
      for (int x = channels; x < image.cols - channels; ++x)
      {
        const auto bend = [&](int y, int at)
        {
          return image.at<std::uint8_t>(y - 1, at) - 2 * image.at<std::uint8_t>(y, at) +
                 image.at<std::uint8_t>(y + 1, at);
        };
        int expected_response = 0;
        int expected_level = 0;
        for (int y = TOP; y < BOTTOM; ++y)
        {
          expected_response += std::abs(bend(y, x - channels) - 2 * bend(y, x) + bend(y, x + channels));
          expected_level += image.at<std::uint8_t>(y, x);
        }
        ASSERT_EQ(response[x], expected_response) << "byte " << x << " of " << image.cols;
        ASSERT_EQ(level[x], expected_level) << "byte " << x << " of " << image.cols;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, NoiseKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

}  // namespace
}  // namespace light_field_depth
