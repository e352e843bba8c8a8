#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DOMAIN_TRANSFORM_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DOMAIN_TRANSFORM_H

#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The two scales of a domain transform (Gastal and Oliveira, 2011).
struct DomainTransformScale
{
  double distance = 0.0;  ///< sigma_s, in samples
  double range = 0.0;     ///< sigma_r, of the sum over three colour channels in 0..1
};

/// Feedback coefficients a^D of the recursive form by colour difference, D = 1 + sigma_s / sigma_r * |dI|.
/// The deviation of pass i of n is sigma_s sqrt(3) 2^(n-i) / sqrt(4^n - 1), halved from pass to pass, so the
/// coefficients of one pass are the squares of those of the pass before.
class FeedbackTable
{
public:
  /// @param iteration counted from 0
  FeedbackTable(const DomainTransformScale& scale, int iteration, int iterations, int channels);

  /// @param difference sum over the channels of the absolute difference of two 8-bit colours
  float operator[](int difference) const { return coefficients_[static_cast<std::size_t>(difference)]; }

private:
  std::vector<float> coefficients_;
};

/// Values and weights that are filtered alike, G*(n f) and G*(n); both CV_32FC1 of one size.
struct WeightedValues
{
  cv::Mat weighted;
  cv::Mat weight;
};

/// One iteration of the spatial domain transform guided by an image, in place: rows, then columns.
/// @param guide CV_8UC1 or CV_8UC3 of the size of the values @param table for its number of channels
/// Runs on the calling thread; thread safe for different values.
void filterSpatially(const cv::Mat& guide, const FeedbackTable& table, WeightedValues& values);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DOMAIN_TRANSFORM_H
