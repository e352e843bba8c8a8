#include "light_field_depth/core/noise_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/preprocess/noise_kernels.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Set by hand: the mean of 64 responses is good to about a tenth, and calm blocks are found between texture.
constexpr int BLOCK_PX = 8;
/// Two blocks.
constexpr int MIN_SIDE_PX = 16;
/// Between black and white, with room for noise of six levels (two deviations) on both sides.
constexpr double DARKEST_LEVEL = 12.0;
constexpr double BRIGHTEST_LEVEL = 243.0;

struct Block
{
  double response;  ///< mean absolute value of the mask
  double level;     ///< mean brightness
};

/// Sums over rows of the image, one for each byte of a row but those of the first and the last pixel.
struct RowSums
{
  explicit RowSums(std::size_t bytes) : response(bytes), level(bytes) {}

  std::vector<std::uint16_t> response;
  std::vector<std::uint16_t> level;
};

void appendBlocks(const RowSums& sums, int width, int channels, int rows,
                  std::vector<std::vector<Block>>& blocks)
{
  for (int left = 1; left + BLOCK_PX <= width - 1 || left == 1; left += BLOCK_PX)
  {
    const int right = std::min(left + BLOCK_PX, width - 1);
    for (int channel = 0; channel < channels; ++channel)
    {
      int response = 0;
      int level = 0;
      for (int x = left; x < right; ++x)
      {
        const auto i = static_cast<std::size_t>(x) * static_cast<std::size_t>(channels) +
                       static_cast<std::size_t>(channel);
        response += sums.response[i];
        level += sums.level[i];
      }
      const double pixels = static_cast<double>(rows) * (right - left);
      blocks[static_cast<std::size_t>(channel)].push_back({response / pixels, level / pixels});
    }
  }
}

/// For each channel.
std::vector<std::vector<Block>> measureBlocks(const cv::Mat& image)
{
  const int channels = image.channels();
  std::vector<std::vector<Block>> blocks(static_cast<std::size_t>(channels));
  RowSums sums(static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(channels));
  for (int top = 1; top + BLOCK_PX <= image.rows - 1 || top == 1; top += BLOCK_PX)
  {
    const int bottom = std::min(top + BLOCK_PX, image.rows - 1);
    sumMaskResponses(image, top, bottom, sums.response.data(), sums.level.data());
    appendBlocks(sums, image.cols, channels, bottom - top, blocks);
  }
  return blocks;
}

double calmResponse(const std::vector<Block>& blocks)
{
  // Texture fills the rest of most images; CALM_TO_MEAN below belongs to it.
  constexpr double CALM_FRACTION = 0.1;
  std::vector<double> responses;
  std::vector<double> all;
  for (const Block& block : blocks)
  {
    all.push_back(block.response);
    if (block.level > DARKEST_LEVEL && block.level < BRIGHTEST_LEVEL)
    {
      responses.push_back(block.response);
    }
  }
  if (responses.size() * 10 < all.size())
  {
    responses = all;
  }
  const auto calm = responses.begin() + static_cast<std::ptrdiff_t>(CALM_FRACTION * responses.size());
  std::nth_element(responses.begin(), calm, responses.end());
  return *calm;
}

}  // namespace

float estimateNoise(const cv::Mat& image)
{
  if ((image.type() != CV_8UC1 && image.type() != CV_8UC3) || image.cols < MIN_SIDE_PX ||
      image.rows < MIN_SIDE_PX)
  {
    throw InputError("Noise is estimated in 8-bit images of at least 16 x 16 pixels; this one has " +
                     std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                     " pixels. Convert or enlarge it.");
  }
  // E|mask| = 6 sigma sqrt(2 / pi) for white noise (Immerkaer 1996). The tenth percentile of means over 64
  // responses is lower than their mean; on images of nothing but noise by 1.23 to 1.26.
  constexpr double NORM_OF_MASK = 6.0;
  constexpr double CALM_TO_MEAN = 1.23;
  /// Of a number that is uniform over one grey level.
  constexpr double VARIANCE_OF_ROUNDING = 1.0 / 12.0;
  double sum = 0.0;
  for (const std::vector<Block>& blocks : measureBlocks(image))
  {
    const double sigma = CALM_TO_MEAN * calmResponse(blocks) * std::sqrt(CV_PI / 2.0) / NORM_OF_MASK;
    sum += std::sqrt(std::max(0.0, sigma * sigma - VARIANCE_OF_ROUNDING));
  }
  return static_cast<float>(sum / image.channels());
}

}  // namespace light_field_depth
