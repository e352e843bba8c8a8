#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_CHANGE_DETECTION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_CHANGE_DETECTION_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/multiview/search/cost_volume.h"
#include "core/multiview/search/label_bands.h"
#include "core/multiview/search/label_space.h"

namespace light_field_depth::multiview
{
/// Decides whether a frame that was searched near the last one's map is believed, from the costs of all
/// labels in every eighth row. Belongs to one sequence.
class ChangeDetector : public RowObserver
{
public:
  /// Before the costs of a frame are computed.
  void begin(const LabelBands& bands);
  bool wants(int y) const override;
  void observe(int y, const std::uint8_t* inside, const std::uint8_t* outside, int width) override;

  /// The frame was searched in full: what it shows is compared with from now on.
  void acceptFull();

  /// The frame was searched in bands. Widens the bands of the tiles where the scene has changed, and of those
  /// around them, to all labels.
  /// @param widened for each tile whether it was widened
  /// @return false if the scene is another one; the frame must then be searched in full
  bool acceptNear(LabelBands& bands, std::vector<std::uint8_t>& widened);

  /// After the first search: remembers how many pixels have the first or last label if the frame was searched
  /// in full.
  void acceptFullMap(const cv::Mat& disparity, const LabelSpace& labels);
  /// Whether a map of a frame that was searched in bands has few more such pixels: others have probably left
  /// the range.
  bool acceptNearMap(const cv::Mat& disparity, const LabelSpace& labels) const;

private:
  /// What the observed rows of one tile say.
  struct TileSample
  {
    int outside = 0;      ///< pixels that a label outside the band explains clearly better
    int unexplained = 0;  ///< pixels that no label explains
  };

  std::size_t index(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  static int unexplainedIn(const std::vector<TileSample>& samples);
  bool hasLeftTheRange() const;
  int unexplainedAround(int row, int column) const;

  int rows_ = 0;
  int columns_ = 0;
  std::vector<TileSample> samples_;
  std::vector<TileSample> last_;  ///< of the last frame
  int unexplained_in_full_ = 0;   ///< of the last frame that was searched in full
  int at_ends_in_full_ = 0;       ///< likewise
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_CHANGE_DETECTION_H
