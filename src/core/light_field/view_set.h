#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_SET_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_SET_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/pixel_kernels.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// One 8-bit image as planes: row after row, and in each row channel after channel, so that the channels of
/// a pixel row lie together. Every row has `pad` replicated pixels on its left and more than that, by
/// at least 64, on its right.
class PlanarImage
{
public:
  /// Keeps the memory when the new image needs no more than the old one.
  void create(int width, int height, int channels, int pad);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  int pad() const { return pad_; }
  /// Bytes from one channel of a row to the next.
  std::size_t channelStride() const { return pitch_; }

  /// The pixel (0, y) of channel 0; y is clamped into the image.
  const std::uint8_t* row(int y) const
  {
    const auto inside = static_cast<std::size_t>(std::clamp(y, 0, height_ - 1));
    return values_.data() + inside * pitch_ * static_cast<std::size_t>(channels_) + pad_;
  }
  std::uint8_t* row(int y) { return const_cast<std::uint8_t*>(std::as_const(*this).row(y)); }

private:
  int width_ = 0;
  int height_ = 0;
  int channels_ = 0;
  int pad_ = 0;
  std::size_t pitch_ = 0;
  std::vector<std::uint8_t> values_;
};

/// A shift of a view along an axis on which it has `side_px` pixels, held back to where nothing but the
/// repeated border is left of it: farther shifts show the same, so that neither memory nor whole numbers need
/// to hold them.
inline double visibleShift(double shift_px, int side_px)
{
  /// Samples of four taps beside the pixel see the border only.
  constexpr int TAPS_PX = 3;
  const double most = side_px + TAPS_PX;
  return std::clamp(shift_px, -most, most);
}

/// Values of colourDifference().
constexpr int COLOUR_DIFFERENCES = 3 * 255 + 1;

/// Sum of the absolute differences of two pixels of one PlanarImage over three channels, 0 ..
/// COLOUR_DIFFERENCES - 1; a grey image counts three times.
inline std::size_t colourDifference(const PlanarImage& image, const std::uint8_t* a, const std::uint8_t* b)
{
  return static_cast<std::size_t>(colourDifference(a, b, image.channelStride(), image.channels()));
}

/// The views that stand in one direction from the reference, as a range of ViewSet::views. What hides a
/// point from one of them tends to hide it from all of them.
struct Arm
{
  int first = 0;
  int last = 0;       ///< one past the last
  int direction = 0;  ///< 0..7, in steps of 45 degrees from +x towards +y
};

/// A view as the estimator uses it.
struct PreparedView
{
  PlanarImage image;
  /// Not 0 where a sample is made of a pixel that View::mask takes out; without a size where there is no
  /// mask.
  PlanarImage masked;
  cv::Point2d steps;      ///< View::steps
  cv::Point2d offset_px;  ///< View::offset_px
  /// Distance from the reference in grid steps, signed: negative in the directions 4..7.
  float position = 0.0F;
  std::size_t index = 0;  ///< into LightField::views
};

/// How views are prepared.
struct ViewSetSettings
{
  bool grey = false;
  double blur_sigma_px = 0.0;  ///< of a Gaussian over every view; 0 for none
  DisparityRange range;        ///< gives the padding, as far as visibleShift() goes
};

/// The views of a light field as planes, ordered by arms, and within an arm by distance.
struct ViewSet
{
  PlanarImage reference;
  PlanarImage reference_masked;     ///< not 0 where View::mask is 0; without a size where there is no mask
  PlanarImage reference_margin;     ///< the same with the pixels whose derivatives a masked one takes part in
  std::vector<PreparedView> views;  ///< without the reference
  std::vector<Arm> arms;

  bool hasMasks() const
  {
    return reference_masked.width() > 0 ||
           std::any_of(views.begin(), views.end(),
                       [](const PreparedView& view) { return view.masked.width() > 0; });
  }
  int width() const { return reference.width(); }
  int height() const { return reference.height(); }
};

/// Prepares the views of an 8-bit light field. Memory of earlier calls is used again.
void prepareViews(const LightField& light_field, const ViewSetSettings& settings, ThreadPool& pool,
                  ViewSet& view_set);

/// The light field with the reference and at most so many views of each arm, the nearest and the farthest
/// among them.
LightField withThinnedArms(const LightField& light_field, int max_views_per_arm);

/// One image as prepareViews() would prepare it.
void preparePlanar(const cv::Mat& image, const ViewSetSettings& settings, int pad, PlanarImage& planar);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_SET_H
