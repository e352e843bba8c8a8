#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_SAMPLE_ROWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_SAMPLE_ROWS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/light_field/view_set.h"
#include "core/multiview/search/label_space.h"

namespace light_field_depth::multiview
{
/// Fractions of a pixel are rounded to 1 / SUBPIXEL_PHASES.
constexpr int SUBPIXEL_PHASES = 16;

/// Where a view sees the reference's pixels when they have the disparity of a label: at (x + dx, y + dy) and
/// a fraction that `phase` stands for.
struct LabelShift
{
  int dx = 0;
  int dy = 0;
  int phase = 0;       ///< into the distinct fractions of this view
  int nearest_dx = 0;  ///< to the nearest whole pixel
  int nearest_dy = 0;
};

/// Rows of one view, resampled to the fractions of a pixel that its labels need, each computed once as the
/// rows are asked for from top to bottom.
class SampleRows
{
public:
  /// @param image must outlive the use of row()
  void reset(const PreparedView& view, const LabelSpace& labels);

  const LabelShift& shift(int label) const { return shifts_[static_cast<std::size_t>(label)]; }

  /// The view's row seen by the reference's row y at a label: points at what pixel (0, y) sees. Channels are
  /// channelStride() apart. Valid until the next call for a row below.
  const std::uint8_t* row(int label, int y);
  std::size_t channelStride() const { return stride_; }

private:
  struct Phase
  {
    int x = 0;  ///< 0..SUBPIXEL_PHASES - 1
    int y = 0;
  };
  int phaseIndex(int x, int y);
  std::uint8_t* slot(const LabelShift& where, int y);
  void interpolate(const Phase& phase, int row, std::uint8_t* values);

  const PlanarImage* image_ = nullptr;
  std::vector<LabelShift> shifts_;
  std::vector<Phase> phases_;
  int first_dy_ = 0;
  int ring_rows_ = 1;
  int asked_y_ = 0;     ///< the row of the last call
  int ring_begin_ = 0;  ///< place in the rings of row asked_y_ + first_dy_
  std::size_t stride_ = 0;
  std::vector<int> row_in_slot_;
  std::vector<std::uint8_t> values_;
  std::vector<std::uint8_t> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_SAMPLE_ROWS_H
