#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_BANDS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_BANDS_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "core/multiview/search/label_space.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Side of the square tiles in which an image is searched; the last ones of a row or column may stand out of
/// the image.
constexpr int TILE_PX = 32;

/// Labels first .. first + count - 1.
struct LabelBand
{
  int first = 0;
  int count = 0;

  int end() const { return first + count; }
  bool contains(int label) const { return label >= first && label < end(); }
};

/// The labels that are tried in each tile of an image.
class LabelBands
{
public:
  /// All labels everywhere. Keeps the memory when it suffices.
  void setAll(int width, int height, int labels);

  /// Around a map: every label that a pixel of the tile or at most `reach_px` from it has, and `margin`
  /// labels more on both sides.
  /// @param disparity CV_32FC1, finite
  void setAround(const cv::Mat& disparity, const LabelSpace& space, int reach_px, float margin,
                 ThreadPool& pool);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int labels() const { return labels_; }  ///< of all bands together

  const LabelBand& at(int row, int column) const { return bands_[index(row, column)]; }
  LabelBand& at(int row, int column) { return bands_[index(row, column)]; }

private:
  std::size_t index(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_ = 0;
  int rows_ = 0;
  int labels_ = 0;
  std::vector<LabelBand> bands_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_BANDS_H
