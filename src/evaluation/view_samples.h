#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_SAMPLES_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_SAMPLES_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// How one view agrees with the reference.
struct ViewAgreement
{
  std::size_t view_index = 0;  ///< into LightField::views
  int seen = 0;                ///< pixels with contrast that are inside of it
  int agreeing = 0;            ///< of them
  cv::Point2d shift_px;        ///< by which it is off its place on the whole

  double share() const { return seen > 0 ? static_cast<double>(agreeing) / seen : 0.0; }
};

/// What a few thousand pixels of the reference and of the other views say.
struct ViewSamples
{
  int pixels = 0;                    ///< looked at
  int textured = 0;                  ///< of them, those with contrast, and finite disparity
  int agreeing = 0;                  ///< of those, with which most of the nearest views agree
  double difference_levels = 0.0;    ///< mean over textured pixels of the median over these views
  double noise_levels = 0.0;         ///< of the reference
  std::vector<ViewAgreement> views;  ///< without the reference
  std::vector<float> disparities;    ///< of the textured pixels
};

/// @param light_field of 8-bit views
/// @param disparity   CV_32FC1 of the reference
ViewSamples sampleViews(const LightField& light_field, const cv::Mat& disparity, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_SAMPLES_H
