#ifndef LIGHT_FIELD_DEPTH_CORE_PATCH_MATCH_H
#define LIGHT_FIELD_DEPTH_CORE_PATCH_MATCH_H

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/angular_volume.h"
#include "light_field_depth/core/dense_descriptor.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Coarse-to-fine PatchMatch along the epipolar line (paper, 3.2.1). The values of the paper are the
/// defaults.
struct PatchMatchOptions
{
  /// Levels of the pyramid, k in the paper. Fewer are used for images too small for that many.
  int levels = 5;
  /// Size of a level over that of the level below it, eta in the paper.
  double pyramid_ratio = 0.5;
  /// Distance of the seeds in pixels. Smaller is slower and follows finer structures.
  int grid_spacing_px = 3;
  /// Most sweeps of propagation and random search on a level; a level that has settled ends earlier.
  int iterations = 6;
  /// First radius of the random search in pixels of the level; it is halved down to 1.
  int search_radius_px = 4;
  /// Largest displacement for one grid step, in pixels, when no disparity range is given. Raise it for scenes
  /// with more; lower it where repeated texture leads astray.
  double max_displacement_px = 40.0;
  /// Fits the minimum of the cost between whole pixels. The paper has whole pixels only.
  bool subpixel = true;
  /// A match is dropped when going there and back ends further from the start than this, in pixels.
  double consistency_threshold_px = 1.0;
  /// Standard deviation, in pixels, of the disagreement of forward and backward matches that weighs a match
  /// by exp(-e^2 / (2 s^2)). Lower it to trust only matches that agree.
  double confidence_sigma_px = 0.4;
  /// Multiplies the weight of a match by DescriptorImage::centreShare(). Descriptors reach 4 px; next to an
  /// object the background matches the object's edge, and this is what keeps its disparity from spreading.
  /// The paper does not have it.
  bool weigh_by_centre = true;
  /// Matches of a connected region of fewer seeds than this, or than a twentieth of all, are dropped. Lower
  /// it for scenes with small parts; raise it where flat areas show spots.
  int min_region_seeds = 50;
  /// Matches that end closer than this to the border of the image are dropped, in pixels.
  int border_px = 2;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const PatchMatchOptions& options);

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

#endif  // LIGHT_FIELD_DEPTH_CORE_PATCH_MATCH_H
