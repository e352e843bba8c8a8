#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_H

#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/median_kernels.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Medians over a map, the borders repeated. Keeps its memory; one call at a time.
class MedianFilter
{
public:
  /// @param label CV_32FC1, finite  @param disparity CV_32FC1, px: the disparities of the medians
  void run(const cv::Mat& label, const LabelSpace& labels, ThreadPool& pool, cv::Mat& disparity);

private:
  ScratchPool<std::vector<float>> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_H
