#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_PATHS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_PATHS_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/paper2017/angular_volume.h"

namespace light_field_depth
{
/// The disparity paths between two neighbouring views of a volume, pixel by pixel.
struct PathLinks
{
  static constexpr std::int32_t NONE = -1;  ///< no index of a pixel
  std::vector<std::int32_t>
      predecessor;  ///< for each pixel of the later view its pixel in the earlier, or NONE
  std::vector<std::int32_t>
      successor;  ///< for each pixel of the earlier view its pixel in the later, or NONE
};

/// Where several pixels end at one, the nearest surface keeps its path and the others, which it occludes,
/// end. Pixels of the later view that no path reaches are joined by their backward disparity.
/// @param disparity, known of the earlier view: CV_32FC1, and where it is above 0 a path starts
/// @param backward_disparity, backward_known of the later view, likewise
PathLinks linkPaths(const ViewPair& pair, const cv::Mat& disparity, const cv::Mat& known,
                    const cv::Mat& backward_disparity, const cv::Mat& backward_known);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_PATHS_H
