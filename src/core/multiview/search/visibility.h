#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/search/label_space.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// A surface of label l has the value l + VISIBILITY_BIAS, rounded down.
constexpr float VISIBILITY_BIAS = 1.5F;
constexpr std::uint8_t NO_SURFACE = 0;      ///< nothing is known to be seen there
constexpr std::uint8_t OUT_OF_FRAME = 255;  ///< hides everything; also where the view is masked
constexpr int MAX_VISIBILITY_LABELS = 250;  ///< with the bias below OUT_OF_FRAME

/// The nearest surface that each view sees at each of its pixels.
class VisibleSurfaces
{
public:
  /// Brings the disparity of the reference view (CV_32FC1, finite) to every view, the nearest in front.
  void warp(const cv::Mat& disparity, const ViewSet& views, const LabelSpace& labels, ThreadPool& pool);

  /// Row y of the view at its pixel 0; outside of the frame, up to pad() pixels left and right and for any y,
  /// the values are OUT_OF_FRAME.
  const std::uint8_t* row(int view, int y) const;

private:
  void quantize(const cv::Mat& disparity, const LabelSpace& labels, ThreadPool& pool);
  void warpInto(const cv::Mat& disparity, const PreparedView& view, std::uint8_t* surface) const;
  void hideMasked(const PreparedView& view, std::uint8_t* surface) const;
  void closeGaps(const PreparedView& view, std::uint8_t* surface) const;

  int width_ = 0;
  int height_ = 0;
  int pad_ = 0;
  std::size_t pitch_ = 0;
  std::size_t view_stride_ = 0;
  std::vector<std::uint8_t> quantized_;  // the map in the units of the surfaces
  std::vector<std::uint8_t> values_;
  std::vector<std::uint8_t> outside_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_H
