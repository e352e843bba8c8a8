#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEQUENCE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEQUENCE_H

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/multiview_options.h"
#include "light_field_depth/core/registration.h"

namespace light_field_depth::multiview
{
/// What was measured on a frame that was searched in full. Range and exposures hold for the frames that
/// follow it; the noise is measured in each.
struct SceneMeasures
{
  std::vector<ViewExposure> exposures;  ///< one for each view
  Registration registration;            ///< that was corrected; neutral without the option
  DisparityRange range;                 ///< in pixels per grid step
  float noise_sigma = 0.0F;             ///< in 8-bit units
};

/// What was asked for on a frame.
struct FrameSettings
{
  MultiviewOptions options;
  std::optional<DisparityRange> disparity_range;
};

/// Knows whether a frame may follow the last one: the same kind of views at the same places, the same
/// settings, and a last frame that came to its end. What the images show is not looked at.
class Sequence
{
public:
  /// The measures of the sequence if this frame may follow; nullptr otherwise. In both cases the sequence is
  /// broken until keep() or begin() is called, so that a frame that throws breaks it.
  const SceneMeasures* follow(const LightField& light_field, const FrameSettings& settings);

  /// The frame given to follow() came to its end.
  void keep() { unbroken_ = true; }

  /// The frame given to follow() was searched in full, with these measures.
  void begin(SceneMeasures measures);

  void forget() { unbroken_ = false; }

private:
  /// What two frames must have in common.
  struct Signature
  {
    FrameSettings settings;
    cv::Size size;
    int type = 0;
    std::size_t reference_index = 0;
    std::vector<cv::Point2d> steps;
    std::vector<cv::Point2d> offsets_px;
  };
  static Signature signatureOf(const LightField& light_field, const FrameSettings& settings);
  static bool agree(const Signature& left, const Signature& right);

  bool unbroken_ = false;
  Signature signature_;
  SceneMeasures measures_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEQUENCE_H
