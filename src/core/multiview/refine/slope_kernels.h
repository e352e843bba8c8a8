#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SLOPE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SLOPE_KERNELS_H

namespace light_field_depth::multiview
{
/// Loops of the slopes of surfaces (surface_slopes.h). Every kernel has a plain version that computes the
/// same values bit for bit.

/// Changes of the disparity along one row: e = here - before, each counted as far as it is known.
struct ChangeRow
{
  const float* here = nullptr;    ///< disparity
  const float* before = nullptr;  ///< of the neighbour that the change is measured against
  const float* weight = nullptr;  ///< of the data
  const float* weight_before = nullptr;
  const float* guide = nullptr;  ///< link by the image alone; 0 where there is no neighbour
  float full_weight = 1.0F;      ///< the data that make a change fully known
  float soft_px = 1.0F;          ///< larger changes are steps, not slopes
  float level_share = 0.0F;      ///< how much a level surface counts, in parts of a known change
  int first = 0;                 ///< pixels first .. width - 1
  int width = 0;
  float* change_sums = nullptr;  ///< += share * e
  float* share_sums = nullptr;   ///< += share + level_share * guide
};

void addChanges(const ChangeRow& row);
void addChangesPlain(const ChangeRow& row);

/// The targets of a row whose links charge the change from the slope instead of the change.
struct LeaningRow
{
  const float* target = nullptr;
  const float* weight = nullptr;
  const float* left = nullptr;         ///< [width + 1], links; 0 at both ends
  const float* up = nullptr;           ///< links, 0 in the first row
  const float* down = nullptr;         ///< links, 0 in the last row
  const float* slope_left = nullptr;   ///< [width + 1]
  const float* slope_above = nullptr;  ///< of this row
  const float* slope_below = nullptr;  ///< of the row below; any in the last row
  int width = 0;
  float* leaning = nullptr;  ///< result
};

void leanRow(const LeaningRow& row);
void leanRowPlain(const LeaningRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SLOPE_KERNELS_H
