#ifndef LIGHT_FIELD_DEPTH_CORE_PAIR_ORDER_H
#define LIGHT_FIELD_DEPTH_CORE_PAIR_ORDER_H

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// When findPairOrder() decides. Parallel cameras are assumed: a pair that was shifted so that its
/// disparities are mostly negative looks like a swapped one. Art of Middlebury is found in both orders;
/// ETH3D's playground, swapped, is not.
struct PairOrderOptions
{
  /// Share of the pixels that match one way over that of the other way; about 1 where disparities have both
  /// signs.
  double min_ratio = 1.9;
  /// Share of the pixels that match the better way. Views that hardly move match at next to no pixel either
  /// way.
  double min_share = 0.30;
};

/// Which of two parallel cameras is the left one.
struct PairOrder
{
  bool decided = false;      ///< false: nothing can be said
  bool swapped = false;      ///< nearly all disparities are negative: the views are named the wrong way round
  double right_share = 0.0;  ///< of the pixels that match each other at positive disparities
  double swapped_share = 0.0;  ///< and at negative ones
};

/// Finds out whether a pair of parallel cameras is swapped: what is seen with positive disparities only, as
/// nothing lies behind infinity, matches there and back at far more pixels with the right sign than with the
/// wrong one. A few milliseconds. Pairs whose images are sheared (focused on a plane) may be undecided, or be
/// right with negative disparities.
/// @param light_field of any type; undecided unless there is exactly one view beside the reference
PairOrder findPairOrder(const LightField& light_field, ThreadPool& pool,
                        const PairOrderOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_PAIR_ORDER_H
