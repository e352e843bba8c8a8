#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_EXCHANGE_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_EXCHANGE_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Two neighbours of the grid that fit each other's places better than their own.
struct ViewExchange
{
  std::size_t first = 0;   ///< into LightField::views
  std::size_t second = 0;  ///< the reference is always the second
  /// Of the smaller of the two gains, in terms of its standard error.
  double significance = 0.0;
};

/// Finds neighbours that have changed places, by how near and far surfaces move in them: a shift of the whole
/// image is left free, so that it tells nothing. Each of the two must match better at the other's place,
/// since a map that is too wide or too narrow makes one of them do so. If the reference is one of them, all
/// other views match better by one step to the same side.
/// @param light_field of 8-bit views
/// @param disparity CV_32FC1 of the reference
/// @param min_significance of both gains
std::vector<ViewExchange> findExchanges(const LightField& light_field, const cv::Mat& disparity,
                                        double min_significance, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_VIEW_EXCHANGE_H
