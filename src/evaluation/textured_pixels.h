#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_TEXTURED_PIXELS_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_TEXTURED_PIXELS_H

#include <array>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Brightness of 3 x 3 pixels, two pixels apart, without its mean.
using Patch = std::array<float, 9>;

/// Mean absolute value in grey levels.
float contrastOf(const Patch& patch);

/// Mean absolute difference in grey levels.
float differenceOf(const Patch& a, const Patch& b);

/// A pixel of the reference with contrast.
struct TexturedPixel
{
  cv::Point2f place;
  float disparity = 0.0F;
  float contrast = 0.0F;
  Patch patch{};
  Patch gradient_x{};
  Patch gradient_y{};
};

/// Pixels of the reference, evenly spread, whose patches have contrast above the noise.
/// @param reference CV_8UC1 or CV_8UC3
/// @param disparity CV_32FC1; pixels that are not finite are left out
/// @param looked_at becomes the number of pixels of which these are a part
std::vector<TexturedPixel> texturedPixels(const cv::Mat& reference, const cv::Mat& disparity, float noise,
                                          int& looked_at);

/// The patch that a view shows of a pixel if it stands at these steps, and is off its place by this shift.
/// @return false outside of the view
bool readSeenPatch(const View& view, const TexturedPixel& pixel, const cv::Point2d& steps,
                   const cv::Point2d& shift_px, Patch& patch);

/// Whether two patches are enough alike to tell the shift between them.
/// @param difference of the patches, in grey levels
bool tellsShift(const TexturedPixel& pixel, float difference);

/// The least squares for the shift of a view.
struct ShiftEquations
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xr = 0.0;
  double yr = 0.0;

  void add(const TexturedPixel& pixel, const Patch& seen);

  /// What the view shows stands by so much to the right of and below where it should.
  cv::Point2d solve() const;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_TEXTURED_PIXELS_H
