#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_QUORUM_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_QUORUM_H

#include <cstddef>
#include <vector>

#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
/// Which views of an array can stand for all of it: the reference view, at least min_views, and one on each
/// side of the reference (left, right, above, below) on which the array has any, since what is hidden from
/// one side is seen from the other.
class ViewQuorum
{
public:
  /// @param min_views 0: three quarters of the views
  ViewQuorum(const ViewArray& array, std::size_t min_views);

  /// @param present one for each view of the array
  bool isEnough(const std::vector<bool>& present) const;

  std::size_t minViews() const { return min_views_; }

private:
  std::size_t reference_;
  std::size_t min_views_;
  std::vector<std::vector<std::size_t>> sides_;  ///< the views of each side that has any
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_QUORUM_H
