#ifndef LIGHT_FIELD_DEPTH_CORE_VIEW_PLACES_H
#define LIGHT_FIELD_DEPTH_CORE_VIEW_PLACES_H

#include <cstddef>
#include <vector>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// When checkViewPlaces() doubts a view. Measured by `bench --order`.
struct ViewPlacesOptions
{
  /// A view is out of its place if its cost there is so many times that at the best other place of the grid,
  double min_misplaced_ratio = 1.6;
  /// and that place is at least so many grid steps away.
  double min_steps_away = 1.0;
  /// A view is of another scene if its cost is above this at every place, where 0 is a perfect match and 1.1
  /// is that of unrelated images,
  double min_foreign_cost = 0.65;
  /// and above so many times the median of all views.
  double min_foreign_ratio = 2.5;
  /// Share of doubted views above which the views are shuffled.
  double min_shuffled_share = 0.4;
};

/// A view that does not fit where it claims to stand.
struct ViewDoubt
{
  /// Why it does not fit.
  enum class Kind
  {
    Misplaced,  ///< it fits at `better_place`
    Foreign     ///< it fits nowhere
  };
  std::size_t view_index = 0;   ///< into LightField::views
  Kind kind = Kind::Misplaced;  ///< which of the two
  GridPosition better_place;    ///< where it fits best; only if misplaced
  double cost = 0.0;            ///< at its own place
  double best_cost = 0.0;       ///< at the best place
};

/// What the images say of the places of the single views.
struct ViewPlaces
{
  bool checked = false;           ///< false: too little can be matched to tell
  std::vector<ViewDoubt> doubts;  ///< one for each view that does not fit
  bool shuffled = false;          ///< so many are doubted that their order as a whole is
  double median_cost = 0.0;       ///< of all views at their own places
};

/// Finds views that stand in another's place, or that show another scene.
///
/// The disparities of the points with the best contrast are found with the views nearest to the reference,
/// and each view is compared with the reference at these points as if it stood at each place of the grid. If
/// most views seem out of place, it may be the reference: then the check is repeated with a neighbour of it.
///
/// 10 ms for 17 views of 512 x 512 pixels on one thread.
/// @param light_field of any type, in the right layout (see core/view_layout.h)
ViewPlaces checkViewPlaces(const LightField& light_field, ThreadPool& pool,
                           const ViewPlacesOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_VIEW_PLACES_H
