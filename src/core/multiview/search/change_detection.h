#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_CHANGE_DETECTION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_CHANGE_DETECTION_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/multiview/search/label_bands.h"
#include "core/multiview/search/label_space.h"

namespace light_field_depth::multiview
{
/// When a frame that was searched near the last one's map is believed.
struct ChangeDetectionSettings
{
  /// A label outside the band speaks against it if its cost is lower by this, in the units of FULL_COST.
  int clearly_better = 30;
  /// Sampled pixels of a tile (of 128) that must say so before the tile is searched in full.
  int outside_pixels = 3;
  /// Share of the tiles that must be searched in full before the scene counts as another one.
  float max_changed_tiles = 0.35F;
  /// A pixel whose best cost of all is above this has its disparity outside the range, or is occluded.
  int unexplained_cost = 120;
  /// More such pixels in a tile than in the last frame there mean that something has left the range.
  int unexplained_more = 24;
  /// More such pixels in the whole image than in the last frame that was searched in full, as a share.
  float unexplained_more_share = 0.01F;
  /// More pixels at the first or last label than in the last frame that was searched in full, as a share.
  float at_ends_more_share = 0.003F;
};

/// What the sampled rows of one tile say.
struct TileSample
{
  int outside = 0;      ///< pixels that a label outside the band explains clearly better
  int unexplained = 0;  ///< pixels that no label explains
};

/// Every so many rows the costs of all labels are computed, whatever the bands.
constexpr int WATCHED_ROW_STRIDE = 8;
constexpr int WATCHED_ROW = 3;

inline bool isWatchedRow(int y)
{
  return y % WATCHED_ROW_STRIDE == WATCHED_ROW;
}

/// Decides whether a sequence goes on. Belongs to one sequence.
class ChangeDetector
{
public:
  /// Before the costs of a frame are computed.
  void begin(const LabelBands& bands);
  TileSample& at(int row, int column) { return samples_[index(row, column)]; }

  /// The frame was searched in full: what it shows is compared with from now on.
  void acceptFull();

  /// The frame was searched in bands. Widens the bands of the tiles where the scene has changed, and of those
  /// around them, to all labels.
  /// @param widened for each tile whether it was widened
  /// @return false if the scene is another one; the frame must then be searched in full
  bool acceptNear(const ChangeDetectionSettings& settings, LabelBands& bands,
                  std::vector<std::uint8_t>& widened);

  /// After the first search: remembers how many pixels have the first or last label if the frame was searched
  /// in full.
  void acceptFullMap(const cv::Mat& disparity, const LabelSpace& labels);
  /// Whether a map of a frame that was searched in bands has few more such pixels: others have probably left
  /// the range.
  bool acceptNearMap(const ChangeDetectionSettings& settings, const cv::Mat& disparity,
                     const LabelSpace& labels) const;

private:
  std::size_t index(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  bool hasLeftTheRange(const ChangeDetectionSettings& settings) const;
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
