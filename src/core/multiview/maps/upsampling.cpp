#include "core/multiview/maps/upsampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/light_field/view_set.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 32;  // of the full resolution; even
constexpr int EDGE_RADIUS = 1;      // reduced pixels that vote at an edge
/// Difference of colour, mean of the channels, that lowers a weight by e. Set by hand, like the next.
constexpr float COLOUR_SCALE = 12.0F;
constexpr float DISTANCE_SCALE = 0.9F;  // distance in reduced pixels at which a weight has fallen to a half

/// The full resolution from the reduced one, row by row.
class Upsampler
{
public:
  Upsampler(const cv::Mat& half_disparity, const cv::Mat& half_confidence, float edge_jump,
            const cv::Mat& image, cv::Mat& disparity, cv::Mat& confidence)
      : half_disparity_(half_disparity), half_confidence_(half_confidence), edge_jump_(edge_jump),
        image_(image), disparity_(disparity), confidence_(confidence), channels_(image.channels())
  {
    for (std::size_t i = 0; i < colour_weights_.size(); ++i)
    {
      colour_weights_[i] = std::exp(-static_cast<float>(i) / (static_cast<float>(channels_) * COLOUR_SCALE));
    }
  }

  void run(int first, int last) const
  {
    std::vector<float> line(static_cast<std::size_t>(half_disparity_.cols));
    for (int y = first; y < last; ++y)
    {
      interpolateRow(half_disparity_, y, line.data(), disparity_.ptr<float>(y));
      interpolateRow(half_confidence_, y, line.data(), confidence_.ptr<float>(y));
      decideEdges(y);
    }
  }

private:
  int halfRow(int y) const { return std::min(y / 2, half_disparity_.rows - 1); }

  /// Linear: a pixel lies a quarter of a reduced pixel away from the middle of the reduced pixel it is in.
  void interpolateRow(const cv::Mat& half, int y, float* line, float* result) const
  {
    // Weights of linear interpolation at a quarter of the distance.
    constexpr float near = 0.75F;
    constexpr float far = 0.25F;
    const int row = halfRow(y);
    const int other = std::clamp(y % 2 == 0 ? row - 1 : row + 1, 0, half.rows - 1);
    const auto* const here = half.ptr<float>(row);
    const auto* const beside = half.ptr<float>(other);
    const int width = half.cols;
    for (int x = 0; x < width; ++x)
    {
      line[x] = near * here[x] + far * beside[x];
    }
    for (int x = 1; x + 1 < width; ++x)
    {
      result[2 * x] = near * line[x] + far * line[x - 1];
      result[2 * x + 1] = near * line[x] + far * line[x + 1];
    }
    result[0] = line[0];
    result[1] = near * line[0] + far * line[std::min(1, width - 1)];
    result[2 * width - 2] = near * line[width - 1] + far * line[std::max(width - 2, 0)];
    std::fill(result + 2 * width - 1, result + disparity_.cols, line[width - 1]);
  }

  /// Finds the reduced pixels of this row at a depth edge, and decides each of their pixels.
  void decideEdges(int y) const
  {
    const int row = halfRow(y);
    const int width = half_disparity_.cols;
    const auto* const above = half_disparity_.ptr<float>(std::max(row - 1, 0));
    const auto* const here = half_disparity_.ptr<float>(row);
    const auto* const below = half_disparity_.ptr<float>(std::min(row + 1, half_disparity_.rows - 1));
    float* const result = disparity_.ptr<float>(y);
    std::array<float, 3> low_of{};
    std::array<float, 3> high_of{};
    const auto column = [&](int x, std::size_t slot)
    {
      low_of[slot] = std::min({above[x], here[x], below[x]});
      high_of[slot] = std::max({above[x], here[x], below[x]});
    };
    column(0, 0);
    column(0, 1);
    for (int x = 0; x < width; ++x)
    {
      column(std::min(x + 1, width - 1), static_cast<std::size_t>((x + 2) % 3));
      const float lowest = std::min({low_of[0], low_of[1], low_of[2]});
      const float highest = std::max({high_of[0], high_of[1], high_of[2]});
      if (highest - lowest > edge_jump_)
      {
        const float middle = 0.5F * (lowest + highest);
        const int end = x + 1 == width ? disparity_.cols : 2 * x + 2;
        for (int full_x = 2 * x; full_x < end; ++full_x)
        {
          result[full_x] = decide(full_x, y, middle);
        }
      }
    }
  }

  /// What the pixels around that have the same colour say, the nearest most, from the side that has more say.
  float decide(int x, int y, float middle) const
  {
    const float half_x = 0.5F * (static_cast<float>(x) - 0.5F);
    const float half_y = 0.5F * (static_cast<float>(y) - 0.5F);
    const int centre_x = std::min(x / 2, half_disparity_.cols - 1);
    const int centre_y = halfRow(y);
    std::array<float, 2> weight{};
    std::array<float, 2> sum{};
    const float falloff = 1.0F / DISTANCE_SCALE;
    const std::uint8_t* const pixel =
        image_.ptr<std::uint8_t>(y) + static_cast<std::ptrdiff_t>(x) * channels_;
    for (int qy = std::max(centre_y - EDGE_RADIUS, 0);
         qy <= std::min(centre_y + EDGE_RADIUS, half_disparity_.rows - 1); ++qy)
    {
      const auto* const row = half_disparity_.ptr<float>(qy);
      for (int qx = std::max(centre_x - EDGE_RADIUS, 0);
           qx <= std::min(centre_x + EDGE_RADIUS, half_disparity_.cols - 1); ++qx)
      {
        const float dx = static_cast<float>(qx) - half_x;
        const float dy = static_cast<float>(qy) - half_y;
        const float distance = (dx * dx + dy * dy) * falloff * falloff;
        const float w = colourWeight(pixel, qx, qy) / (1.0F + distance * distance);
        const std::size_t side = row[qx] > middle ? 1 : 0;
        weight[side] += w;
        sum[side] += w * row[qx];
      }
    }
    const std::size_t side = weight[1] > weight[0] ? 1 : 0;
    return sum[side] / std::max(weight[side], 1e-12F);
  }

  /// Of the colour of a pixel against the mean colour of a reduced pixel.
  float colourWeight(const std::uint8_t* pixel, int half_x, int half_y) const
  {
    const std::uint8_t* const upper =
        image_.ptr<std::uint8_t>(2 * half_y) + static_cast<std::ptrdiff_t>(half_x) * 2 * channels_;
    const std::uint8_t* const lower = upper + image_.step;
    int difference = 0;
    for (int c = 0; c < channels_; ++c)
    {
      const int sum = upper[c] + upper[c + channels_] + lower[c] + lower[c + channels_];
      difference += std::abs(sum - 4 * pixel[c]);
    }
    return colour_weights_[static_cast<std::size_t>(difference / 4)];
  }

  const cv::Mat& half_disparity_;
  const cv::Mat& half_confidence_;
  float edge_jump_;
  const cv::Mat& image_;
  cv::Mat& disparity_;
  cv::Mat& confidence_;
  int channels_;
  std::array<float, COLOUR_DIFFERENCES> colour_weights_{};
};

}  // namespace

void upsample(const cv::Mat& half_disparity, const cv::Mat& half_confidence, float edge_jump,
              const cv::Mat& image, ThreadPool& pool, cv::Mat& disparity, cv::Mat& confidence)
{
  disparity.create(image.size(), CV_32FC1);
  confidence.create(image.size(), CV_32FC1);
  const Upsampler upsampler(half_disparity, half_confidence, edge_jump, image, disparity, confidence);
  pool.parallelFor(0, image.rows, ROWS_PER_CHUNK, [&](int first, int last) { upsampler.run(first, last); });
}

}  // namespace light_field_depth::multiview
