#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SEARCH_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SEARCH_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/search/background_fusion.h"
#include "core/multiview/search/change_detection.h"
#include "core/multiview/search/cost_volume.h"
#include "core/multiview/search/label_bands.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/median.h"
#include "core/multiview/search/path_aggregation.h"
#include "core/multiview/search/visibility.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth::multiview
{
struct SearchSettings
{
  CostSettings cost;
  PathSettings paths;  ///< small_change_penalty for labels 1/8 px apart, scaled to what the labels need
  /// The labels of the first search are so many times as far apart: it has to find the surfaces, not their
  /// shapes. 1 takes a fifth more time, 4 (half a pixel) makes demo's BadPix 0.07 14.2 % of 11.5.
  float first_label_step_share = 2.0F;
  /// Of P1 and P2 in the last search. The first one has to find the surfaces from costs that occlusions
  /// spoil; the last one knows who sees what, and may follow their shapes and contours more freely.
  float last_small_change_share = 1.5F;
  float last_large_change_share = 0.7F;
  int visibility_passes = 1;
  bool fuse_background = true;
  bool keep_thin_structures = false;
  bool detect_changes = false;  ///< so that the next frame may follow
};

/// What is searched.
struct SearchInput
{
  const ViewSet& views;
  const PlanarImage& guide;  ///< the reference; its edges lower the penalty of changes
  const LabelSpace& labels;
};

/// Both CV_32FC1, px, finite.
struct SearchMaps
{
  cv::Mat first;  ///< before it is known which view sees what
  cv::Mat last;
};

/// Finds the label of each pixel that costs least with its neighbours', first with the best arms of views,
/// then with the views that see the surfaces found. Keeps its buffers; one call at a time.
class LabelSearch
{
public:
  /// @param around CV_32FC1, px, finite, of the size of the views: labels near this map alone are tried.
  ///   Empty: all labels.
  /// @return true; with detect_changes and `around` false if the views show another scene than those of the
  ///   last call, which must have had the same labels and settings. The maps are then of no use.
  bool run(const SearchInput& input, const SearchSettings& settings, const cv::Mat& around,
           RunContext& context, SearchMaps& maps);

private:
  bool findFirstMap(const SearchInput& input, const SearchSettings& settings, const CostSettings& cost,
                    const cv::Mat& around, RunContext& context, cv::Mat& disparity);
  bool computeFirstCosts(const SearchInput& input, const SearchSettings& settings, const CostSettings& cost,
                         const cv::Mat& around, RunContext& context);
  bool acceptFirstMap(const SearchInput& input, bool all_labels, const cv::Mat& disparity,
                      RunContext& context);
  void setPaths(const SearchInput& input, const PathSettings& paths, RunContext& context);
  void aggregate(const SearchInput& input, const SearchSettings& settings, RunContext& context,
                 cv::Mat& disparity);
  void fuseBackground(const SearchInput& input, const SearchSettings& settings, RunContext& context,
                      cv::Mat& disparity);
  void computeVisibleCosts(const SearchInput& input, const SearchSettings& settings, const CostSettings& cost,
                           const cv::Mat& disparity, RunContext& context);

  PathSettings paths_;  // of the present aggregation
  LabelBands bands_;
  CostVolumeBuilder cost_builder_;
  CostVolume volume_;
  ChangeDetector changes_;
  std::vector<std::uint8_t> changed_tiles_;
  PathAggregator aggregator_;
  MedianFilter median_;
  BackgroundFusion background_;
  VisibleSurfaces surfaces_;
  cv::Mat label_;          // CV_32FC1, of the last aggregation
  cv::Mat with_charges_;   // CV_32FC1, px: the search that prefers the background
  cv::Mat before_median_;  // CV_32FC1, px
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SEARCH_H
