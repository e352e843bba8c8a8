#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_FUSION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_FUSION_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/multiview/search/cost_volume.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/path_aggregation.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Moves textureless regions back to the background. A contour moves with its nearer side, so a region
/// without texture belongs to the farthest of its borders; a search that only asks for smoothness may leave
/// it at any of them. A second search is made with costs that grow towards the viewer, down to a floor of
/// what the images really support nearby. Connected regions that it places farther are taken over where that
/// lowers the energy of the first search, a fusion move. Keeps its memory; one call at a time.
class BackgroundFusion
{
public:
  /// Before the second search: finds the floor and adds the charges to the volume.
  /// @param disparity CV_32FC1, px, the first search
  void prepare(const LabelSpace& labels, const cv::Mat& disparity, ThreadPool& pool, CostVolume& volume);

  /// After it: takes over the regions whose energy falls.
  /// @param volume as prepare() left it
  /// @param background CV_32FC1, px, the second search
  /// @param disparity the first search on entry, the fused map on return
  void fuse(const CostVolume& volume, const PathAggregator& paths, const PathSettings& path_settings,
            const cv::Mat& background, ThreadPool& pool, cv::Mat& disparity);

  /// Charges in a later volume for labels nearer than what was moved back.
  /// @param labels of that volume
  void chargeMoved(const LabelSpace& labels, ThreadPool& pool, CostVolume& volume) const;

private:
  struct Region;
  void countSupportedLabels(const cv::Mat& disparity, const CostVolume& volume, ThreadPool& pool);
  void countSupportedLabels(int tile_column, int y, int threshold, const CostVolume& volume, int* counts);
  void chooseFloors(int block_y, int labels);
  void chargeBlock(int block_x, int block_y, const std::vector<std::uint8_t>& charge,
                   CostVolume& volume) const;
  bool markFarther(const cv::Mat& background, ThreadPool& pool, const cv::Mat& disparity);
  template <class Body>
  void forFarther(const cv::Range& rows, const Body& body) const;
  bool isRowMarked(int y) const { return marked_rows_[static_cast<std::size_t>(y)] != 0; }
  std::vector<Region> addRegions(const CostVolume& volume, const PathAggregator& paths,
                                 const PathSettings& settings, const cv::Mat& background, std::size_t count,
                                 ThreadPool& pool) const;
  void addData(const CostVolume& volume, const cv::Mat& background, const cv::Range& rows,
               std::vector<Region>& regions) const;
  void addLinks(const PathAggregator& paths, const PathSettings& settings, const cv::Mat& background,
                const cv::Range& rows, std::vector<Region>& regions) const;
  std::size_t regionAt(int x, int y) const { return static_cast<std::size_t>(regions_.at<int>(y, x)); }
  float biasAt(int x, int y, float label) const;

  // Costs in the units of FULL_COST.
  static constexpr float CHARGE_PER_PX = 12.0F;  // for a label nearer than the floor
  static constexpr int MAX_CHARGE = 48;

  LabelSpace labels_;
  cv::Mat label_;               // CV_32FC1 of the first search
  cv::Mat data_cost_;           // CV_32FC1 of the first search, without charges
  std::vector<int> supported_;  // pixels with a supported label: [row of tiles][column of blocks][label]
  cv::Mat floor_;               // CV_16SC1, one element a block
  cv::Mat moved_;               // CV_16SC1: the label that a pixel was moved to, or -1
  cv::Mat farther_;             // CV_8UC1: 1 where the second search is farther
  std::vector<std::uint8_t> marked_rows_;  // of these: whether a row has any
  cv::Mat regions_;                        // CV_32SC1
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_FUSION_H
