#ifndef LIGHT_FIELD_DEPTH_EVALUATION_VERDICT_H
#define LIGHT_FIELD_DEPTH_EVALUATION_VERDICT_H

#include <string>
#include <vector>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// One thing that was checked.
struct Finding
{
  /// How much a finding says against the result.
  enum class Severity
  {
    Fine,     ///< for the record
    Warning,  ///< the result cannot be right, or not in all of the image
  };

  std::string name;                    ///< "agreement", "view", "registration", ...
  Severity severity = Severity::Fine;  ///< what the limits of VerdictOptions make of `value`
  double value = 0.0;                  ///< the figure that was checked, in the unit of its limit
  std::string sentence;                ///< what it is; with the remedy if it is a warning
};

/// "fine", "warning".
std::string toString(Finding::Severity severity);

/// Whether a result can be right.
struct Verdict
{
  std::vector<Finding> findings;  ///< of every check that could be made

  /// Whether there is a warning among them.
  bool isDoubtful() const;
  /// The sentences of the warnings.
  std::vector<std::string> warnings() const;
};

/// Limits of the checks, set on light fields of real cameras, rendered ones and spoiled ones.
struct VerdictOptions
{
  /// Share of the pixels with contrast at which most of the nearest views agree; less is a warning.
  double min_agreement = 0.50;
  /// A view is doubted if it agrees at less than this share of them, and at less than this share of what the
  /// median view does.
  double min_view_agreement = 0.30;
  double min_relative_view_agreement = 0.5;  ///< in parts of the agreement of the median view
  /// Pixels that a view is off its place on the whole.
  double max_misregistration_px = 0.6;
  /// Of the gain of both of two neighbours in each other's places, in terms of its standard error. Of 23
  /// right light fields none has a pair with 1; of pairs that changed places it is 4 to 50.
  double min_exchange_significance = 4.0;
  /// Share of the pixels with contrast at one end of the range that was searched.
  double max_share_at_bound = 0.10;
  /// Grey levels between the first and the last hundredth of the pixels.
  double min_grey_levels = 8.0;
  double min_grey_levels_after_conversion = 24.0;  ///< of views that had sixteen bits
  /// Standard deviation of a view's grey levels.
  double min_contrast_levels = 1.0;
  /// Share of the pixels that have contrast at all.
  double min_texture = 0.002;
  /// Share of the map that is filled from around because the views tell nothing there: of eleven captures,
  /// renders and pairs 0 to 0.5, of a room of white walls 0.97.
  double max_filled = 0.75;
  /// Fewer pixels with contrast say nothing of the agreement.
  double min_texture_for_agreement = 0.03;
};

/// Judges a result by the views that it came from: whether they agree with each other at the disparities
/// found, as views of one scene in the right order do, beside what is wrong with single views.
///
/// Looks at a few thousand pixels and at most 24 views: 12 ms for 17 views of 512 x 512 on one thread.
/// @param light_field that was given to the estimator
/// @return the findings, warnings first
Verdict judgeResult(const LightField& light_field, const DisparityEstimate& estimate, ThreadPool& pool,
                    const VerdictOptions& options = {});

/// Judges the places of the views by their images alone: the layout of the grid, views out of place or of
/// another scene, and, if wanted, the sign of the disparity (see core/view_layout.h, view_places.h,
/// depth_sign.h).
/// @param with_layout false: where the layout and the sign have been found already
Verdict judgeOrder(const LightField& light_field, ThreadPool& pool, bool with_layout = true);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_VERDICT_H
