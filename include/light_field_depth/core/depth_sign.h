#ifndef LIGHT_FIELD_DEPTH_CORE_DEPTH_SIGN_H
#define LIGHT_FIELD_DEPTH_CORE_DEPTH_SIGN_H

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// When findDepthSign() decides. Measured by `bench --order`.
struct DepthSignOptions
{
  /// Parts of the image with a depth edge that tells one of the two signs.
  int min_votes = 8;
  /// Share of the votes that go to the winner.
  double min_share = 0.75;
  /// Of the mean vote, in terms of its standard error.
  double min_significance = 3.0;
};

/// Which of the two ends of the disparities is near, as occlusions tell.
struct DepthSign
{
  bool decided = false;  ///< false: the occlusions do not tell
  /// Large disparities are far: rows and columns both run backwards. Only if decided.
  bool reversed = false;
  /// Of all but the nearest and the farthest twentieth of the image, as a first search found them.
  DisparityRange range;
  int votes = 0;              ///< depth edges that took a side
  double share = 0.5;         ///< of the votes, for large disparities being near
  double significance = 0.0;  ///< positive where large disparities are near
};

/// Finds out whether large disparities are near, as they should be. Matches cannot tell, but occlusions do:
/// at a depth edge the nearer side hides the other one in the views towards which it moves.
///
/// The disparity comes from a search that treats both signs alike. At its edges, in the view in which the
/// side of larger disparity moves over the other one, the bands of both sides that may be hidden are compared
/// with the reference; the view on the opposite side, in which nothing is hidden there, tells how well the
/// bands match anyway. Undecided for flat scenes, and for views that stand so close that nothing is hidden.
///
/// About the time of the preset realtime.
/// @param light_field of any type, in the right layout (see core/view_layout.h) up to this sign
DepthSign findDepthSign(const LightField& light_field, ThreadPool& pool,
                        const DepthSignOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_DEPTH_SIGN_H
