#ifndef LIGHT_FIELD_DEPTH_CORE_VARIATIONAL_REFINEMENT_H
#define LIGHT_FIELD_DEPTH_CORE_VARIATIONAL_REFINEMENT_H

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Which views the refinement compares with the reference view.
enum class RefinementViews
{
  All,       ///< every view of the volumes
  Adjacent,  ///< the nearest on each side of the reference view
  Outermost  ///< the furthest on each side
};

/// "all", "adjacent", "outermost".
std::string toString(RefinementViews views);
/// The inverse of toString(). @throw InputError that lists the names.
RefinementViews refinementViewsFromString(const std::string& name);

/// The one-step variational refinement of EpicFlow (paper, 3.3.1), reduced to disparity.
struct VariationalOptions
{
  bool enabled = true;
  RefinementViews views = RefinementViews::All;
  /// Weight of the smoothness. Raise it for noisy views.
  double smoothness = 1.0;
  /// Weight of the gradient constancy.
  double gradient_weight = 0.71;
  /// Smoothness falls by exp(-kappa |grad I|) at edges of the image, I in 0..1.
  double edge_kappa = 5.0;
  /// Standard deviation of the Gaussian that smooths the views first, in pixels. EpicFlow has 1; less keeps
  /// disparity edges closer to the edges of the image. Raise it for noisy views.
  double presmoothing_px = 0.7;
  /// How often the views are warped again.
  int warps = 5;
  /// Sweeps of successive over-relaxation for each warp.
  int sor_iterations = 30;
  /// Over-relaxation, in (0, 2).
  double sor_omega = 1.9;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const VariationalOptions& options);

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

#endif  // LIGHT_FIELD_DEPTH_CORE_VARIATIONAL_REFINEMENT_H
