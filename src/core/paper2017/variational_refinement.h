#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VARIATIONAL_REFINEMENT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VARIATIONAL_REFINEMENT_H

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/paper2017_options.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Minimises, over the disparity d of the reference view,
///   1/K sum_k Psi(gamma (grad I_k(p - d s_k) - grad I_0(p))^2 normalised) + alpha exp(-kappa |grad I_0|)
///   Psi(|grad d|^2)
/// with Psi(a^2) = sqrt(a^2 + 0.001^2), all K views in one problem with one unknown a pixel: a view k steps
/// away sees k times the displacement, and the robust Psi, which each view has for itself, discounts the
/// views that do not see the point.
/// @param light_field 8-bit views @param view_indices the views to compare; the reference is left out
/// @param disparity CV_32FC1, finite, of the reference view
/// @return CV_32FC1
cv::Mat refineDisparity(const LightField& light_field, const std::vector<std::size_t>& view_indices,
                        const cv::Mat& disparity, const VariationalOptions& options, ThreadPool& pool);

/// The subset of view indices that an option names.
std::vector<std::size_t> refinementViews(const LightField& light_field,
                                         const std::vector<std::size_t>& view_indices, RefinementViews views);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VARIATIONAL_REFINEMENT_H
