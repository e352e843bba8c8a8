#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_KERNELS_H

namespace light_field_depth::multiview
{
/// What is known of a row of disparities (ConfidenceEvidence), [width] each.
struct EvidenceRow
{
  const float* disparity = nullptr;
  const float* searched = nullptr;
  const float* first_search = nullptr;
  const float* target = nullptr;
  const float* weight = nullptr;
  const float* disagreement = nullptr;
  const float* residual = nullptr;
  const float* low = nullptr;  ///< least and largest disparity in 3 x 3 pixels
  const float* high = nullptr;
  const float* wide_low = nullptr;  ///< in 5 x 5 pixels
  const float* wide_high = nullptr;
  float noise_sigma = 0.0F;
  int width = 0;
};

/// The logarithm of the odds that each disparity is wrong. The plain version computes the same values bit for
/// bit.
void weighEvidence(const EvidenceRow& row, float* against);
void weighEvidencePlain(const EvidenceRow& row, float* against);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_KERNELS_H
