#include "light_field_depth/core/multiview/confidence.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 32;

/// Weights of the evidence against a disparity; the limits keep one piece of evidence from being everything.
constexpr float BASE = -6.9F;
constexpr float EDGE_WEIGHT = 12.0F;      // a jump in 3 x 3 pixels
constexpr float NEAR_EDGE_WEIGHT = 4.0F;  // in 5 x 5 pixels
constexpr float EDGE_FROM_PX = 0.05F;
constexpr float NEAR_EDGE_FROM_PX = 0.1F;
constexpr float EDGE_WIDTH_PX = 0.3F;
constexpr float UNCERTAINTY_WEIGHT = 20.0F;  // of 1 / sqrt(curvature)
constexpr float DISAGREEMENT_WEIGHT = 25.0F;
constexpr float DISAGREEMENT_LIMIT_PX = 0.3F;
constexpr float PULL_WEIGHT = 18.0F;  // from the views' minimum to the smooth surface
constexpr float PULL_LIMIT_PX = 0.15F;
constexpr float MOVE_WEIGHT = 27.0F;  // by the refinement
constexpr float MOVE_LIMIT_PX = 0.3F;
constexpr float CHANGE_WEIGHT = 6.4F;  // from the first search to the second
constexpr float CHANGE_LIMIT_PX = 0.3F;
constexpr float RESIDUAL_WEIGHT = 0.1F;
constexpr float RESIDUAL_FREE = 15.0F;      // sum of three channels
constexpr float RESIDUAL_PER_NOISE = 4.0F;  // of a difference of two noisy pixels, three channels

/// Largest minus smallest value about each pixel of some rows.
class Spread
{
public:
  Spread(const cv::Mat& disparity, int first, int last, int radius) : first_(first)
  {
    const cv::Mat window = cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
    // Part of a larger matrix: the filters see the rows above and below as well.
    const cv::Mat rows = disparity.rowRange(first, last);
    cv::dilate(rows, high_, window);
    cv::erode(rows, low_, window);
  }

  float at(int x, int y) const { return high_.at<float>(y - first_, x) - low_.at<float>(y - first_, x); }

private:
  int first_;
  cv::Mat high_;
  cv::Mat low_;
};

float ramp(float value, float from, float width)
{
  return std::clamp((value - from) / width, 0.0F, 1.0F);
}

float confidenceAt(const ConfidenceEvidence& evidence, float edge_px, float near_edge_px, int x, int y)
{
  const auto at = [&](const cv::Mat& values) { return values.at<float>(y, x); };
  const Linearization& linear = evidence.linearization;
  const float here = at(evidence.disparity);
  const float pull = std::abs(at(linear.target) - here);
  const float move = std::abs(at(evidence.searched) - here);
  const float change = std::abs(at(evidence.first_search) - at(evidence.searched));
  const float unexplained = at(linear.residual) - RESIDUAL_FREE - RESIDUAL_PER_NOISE * evidence.noise_sigma;
  const float against =
      BASE + EDGE_WEIGHT * ramp(edge_px, EDGE_FROM_PX, EDGE_WIDTH_PX) +
      NEAR_EDGE_WEIGHT * ramp(near_edge_px, NEAR_EDGE_FROM_PX, EDGE_WIDTH_PX) +
      UNCERTAINTY_WEIGHT / std::sqrt(at(linear.weight) + 1.0F) +
      DISAGREEMENT_WEIGHT * std::min(at(linear.disagreement), DISAGREEMENT_LIMIT_PX) +
      PULL_WEIGHT * std::min(pull, PULL_LIMIT_PX) + MOVE_WEIGHT * std::min(move, MOVE_LIMIT_PX) +
      CHANGE_WEIGHT * std::min(change, CHANGE_LIMIT_PX) + RESIDUAL_WEIGHT * std::max(0.0F, unexplained);
  return 1.0F / (1.0F + std::exp(against));
}

}  // namespace

void estimateConfidence(const ConfidenceEvidence& evidence, ThreadPool& pool, cv::Mat& confidence)
{
  confidence.create(evidence.disparity.size(), CV_32FC1);
  pool.parallelFor(0, confidence.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     const Spread close(evidence.disparity, first, last, 1);
                     const Spread wide(evidence.disparity, first, last, 2);
                     for (int y = first; y < last; ++y)
                     {
                       auto* const row = confidence.ptr<float>(y);
                       for (int x = 0; x < confidence.cols; ++x)
                       {
                         row[x] = confidenceAt(evidence, close.at(x, y), wide.at(x, y), x, y);
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
