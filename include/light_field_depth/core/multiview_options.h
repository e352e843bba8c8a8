#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_OPTIONS_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_OPTIONS_H

#include <string>
#include <vector>

namespace light_field_depth
{
/// How much time to spend.
enum class MultiviewPreset
{
  Quality,   ///< colour everywhere, finer labels, occlusions found twice, three refinements
  Balanced,  ///< colour everywhere, two refinements
  Realtime,  ///< brightness alone but at edges, one refinement
  Fast       ///< half the resolution and fewer views, brought to the full one along the edges of the image
};

/// "quality", "balanced", "realtime", "fast".
std::string toString(MultiviewPreset preset);
/// The inverse of toString(). @throw InputError that lists the names.
MultiviewPreset multiviewPresetFromString(const std::string& name);

/// Settings of the multi-view method. Disparities are meant for an outermost view four grid steps away from
/// the reference; wider and narrower arrays scale them, so that they stand for the same motion in the
/// outermost view. Costs are in units of which 240 is the worst matching cost. What depends on noise starts
/// from these values and grows with the noise that is measured.
struct MultiviewOptions
{
  /// PRESET_NUMBER leaves a number to the preset.
  static constexpr int PRESET_NUMBER = -1;

  MultiviewPreset preset = MultiviewPreset::Balanced;  ///< time against accuracy
  /// Distance between the disparities that are tried, in pixels; smaller is slower and finer. PRESET_NUMBER:
  /// 1/16 with the preset quality, 3/16 for a pair of views with realtime, else 1/8.
  float label_step_px = PRESET_NUMBER;
  /// P1: cost of a change of disparity by 1/8 px between neighbours. Raise it where the result is noisy,
  /// lower it where slanted surfaces show steps.
  int small_change_penalty = 30;
  /// P2: cost of any larger change where the image has no edge. Raise it for large smooth objects, lower it
  /// for fine structures.
  int large_change_penalty = 1200;
  /// Times that the views' occlusions are found from the map and the search repeated. PRESET_NUMBER: twice
  /// with the preset quality, never for a pair of views with realtime, else once.
  int visibility_passes = PRESET_NUMBER;
  /// Move textureless regions to the farthest of their borders; the presets realtime and fast leave it out.
  bool background_fusion = true;
  /// Keep twigs and wires that a median would wipe out. Set it for thickets; elsewhere it keeps more errors
  /// than it saves structures.
  bool thin_structures = false;
  /// Decide by colour to which side a pixel at a depth edge belongs.
  bool boundary_pixels = true;
  /// Times that the disparity is refined below the label step; more help smooth surfaces with gloss.
  int refinements = PRESET_NUMBER;
  /// Let the brightness of a surface change linearly with the position of the view (gloss, soft light).
  bool brightness_slope = true;
  /// Smoothness of the refinement; raise it for smoother surfaces.
  float refinement_smoothness = 200.0F;
  /// Measure from the images how far views stand out of place (shifts, rolls, zooms, unequal steps of rows
  /// and columns), and put them right before the search where points that took no part agree better with it;
  /// not with the preset fast. It takes a twentieth of the time where nothing is off, and as long as the
  /// search where something is: the ROS node, whose cameras are calibrated, has it off.
  bool registration = true;
  /// For video: search near the last frame's result where the scene goes on, and in full where it changed.
  /// The result still comes from each frame's own images, but may differ a little from that of the frame
  /// alone.
  bool temporal = false;
};

bool operator==(const MultiviewOptions& left, const MultiviewOptions& right);

/// The options with the numbers that they leave to their preset.
MultiviewOptions withPresetNumbers(MultiviewOptions options);

std::vector<std::string> validate(const MultiviewOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_OPTIONS_H
