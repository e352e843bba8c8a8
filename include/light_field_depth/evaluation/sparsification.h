#ifndef LIGHT_FIELD_DEPTH_EVALUATION_SPARSIFICATION_H
#define LIGHT_FIELD_DEPTH_EVALUATION_SPARSIFICATION_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/evaluation/evaluation.h"

namespace light_field_depth
{
/// How an error falls as the least confident pixels are dropped, beside the ideal that drops the worst pixels
/// first (Ilg et al., Uncertainty Estimates and Multi-Hypotheses Networks for Optical Flow, ECCV 2018).
/// Among pixels of equal confidence the order is taken as random: the curve has the mean over all orders.
struct SparsificationCurve
{
  /// The error of what is left when i / SPARSIFICATION_STEPS of the pixels are dropped, entry i, from nothing
  /// dropped on.
  std::vector<double> error;
  std::vector<double> ideal;  ///< the same if the worst pixels are dropped first
  /// Area between the two curves over all pixel counts, divided by the error of all pixels (AUSE): 0 for the
  /// ideal confidence, and the larger the worse; 0 where there is no error at all.
  double ause = 0.0;
};

/// Steps in which pixels are dropped.
constexpr int SPARSIFICATION_STEPS = 20;

/// What a confidence is worth against truth.
struct Sparsification
{
  SparsificationCurve mse_100;     ///< mean square error x 100
  SparsificationCurve badpix_007;  ///< percentage of pixels with an error above 0.07 px
};

/// What is left without the least confident tenth of the pixels.
double withoutLeastConfidentTenth(const SparsificationCurve& curve);

/// @param confidence CV_32FC1 in the size of the result, larger is surer; NaN counts as least sure
/// @param result, truth, mask, border_px as evaluate() takes them
/// @throw InputError if sizes do not fit or no pixel is left
Sparsification sparsify(const cv::Mat& result, const cv::Mat& confidence, const cv::Mat& truth,
                        const cv::Mat& mask = {}, int border_px = DEFAULT_EVALUATION_BORDER_PX);

/// "ause_mse 0.123  ause_badpix_007 ...", three decimals each, in one line.
std::string toText(const Sparsification& sparsification);

/// {"ause_mse": 0.123, ..., "mse_100_curve": [...], ...}, in one line.
std::string toJson(const Sparsification& sparsification);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_SPARSIFICATION_H
