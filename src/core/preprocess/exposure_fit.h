#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_FIT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_FIT_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/exposure.h"

namespace light_field_depth
{
/// What the reference and another view show of one scene point, in 8-bit units.
struct BrightnessPair
{
  cv::Vec3f reference;
  cv::Vec3f other;
  /// Where the other view sees it; see ViewExposure.
  cv::Vec2f place;
};

/// What the brightness of the other view may differ by.
enum class ExposureModel
{
  Line,  ///< no ViewExposure::bend
  Curve
};

/// The exposure that explains most of the pairs.
/// @param channels 1 or 3; of the values that count
/// @param model with Curve, a line is still taken where it fits about as well
/// @return a neutral one if the pairs are too few or too alike, or need no change
ViewExposure fitExposure(const std::vector<BrightnessPair>& pairs, int channels,
                         ExposureModel model = ExposureModel::Line);

/// (u, v, u^2 + v^2), which ViewExposure::shading is multiplied with.
inline cv::Vec3d shadingTerms(double u, double v)
{
  return {u, v, u * u + v * v};
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_FIT_H
