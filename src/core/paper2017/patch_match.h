#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PATCH_MATCH_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PATCH_MATCH_H

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/paper2017/angular_volume.h"
#include "core/paper2017/dense_descriptor.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/paper2017_options.h"

namespace light_field_depth
{
/// Matches of a grid of seeds. Matrices have one element a seed.
struct SeedMatches
{
  std::vector<int> columns_px;  ///< x of the seed columns
  std::vector<int> rows_px;     ///< y of the seed rows
  cv::Mat disparity;            ///< CV_32FC1, pixels per grid step
  cv::Mat cost;                 ///< CV_32FC1, descriptor distance, 0 .. DescriptorImage::MAX_DISTANCE
  cv::Mat centre_share;         ///< CV_32FC1, 0..1, of the seed's descriptor; 0 where all costs are equal
};

/// Finds for each seed of one view its match in another. Only displacements on the epipolar line are tried.
/// Deterministic: the random numbers depend on nothing but seed, level and sweep.
/// @param from, to descriptorPyramid() of the two views, equally long and of equal sizes
/// @param range searched, in pixels per grid step; up to max_displacement_px when absent
/// @pre validate(options) is empty, pair.steps is not (0, 0)
/// Thread safe.
SeedMatches matchPair(const std::vector<DescriptorImage>& from, const std::vector<DescriptorImage>& to,
                      const ViewPair& pair, const std::optional<DisparityRange>& range,
                      const PatchMatchOptions& options);

/// Sparse estimates in the pixel grid of one view.
struct SparseDisparity
{
  cv::Mat disparity;   ///< CV_32FC1, pixels per grid step; 0 where the confidence is 0
  cv::Mat confidence;  ///< CV_32FC1, 0..1; 0 where there is no match
};

/// Forward-backward check, removal of outliers and confidence; each match that is left is drawn as a square
/// block of the seed spacing.
/// @param there matches of the view whose pixels the result has @param back those of the other view
/// @param pair  as given for `there`
SparseDisparity consistentMatches(const SeedMatches& there, const SeedMatches& back, const ViewPair& pair,
                                  const cv::Size& size, const PatchMatchOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PATCH_MATCH_H
