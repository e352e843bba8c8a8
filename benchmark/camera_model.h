#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_CAMERA_MODEL_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_CAMERA_MODEL_H

#include <cstdint>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::benchmark
{
/// A cheap colour camera of its own for each view, roughly rectified: what separates captures from rendered
/// views. Every part is off at 0 (false). The defaults are of the size that captures of gantries and of
/// arrays show.
struct CameraModel
{
  double shift_px = 0.15;     ///< standard deviation of what rectification leaves, along x and along y
  double roll_degrees = 0.1;  ///< standard deviation, about the middle of the image
  double blur_px = 0.7;       ///< standard deviation of the lens' Gaussian
  double gain = 0.05;         ///< standard deviation about 1
  double full_well = 8000.0;  ///< electrons at white, for the noise of the photons
  double read_noise = 6.0;    ///< standard deviation, electrons; off without full_well
  bool mosaic = true;         ///< RGGB filters and their interpolation; grey cameras have none
  int jpeg_quality = 90;      ///< 1..100
  std::uint64_t seed = 7;
};

/// The views as such cameras take them; they stay 8-bit, colour or grey. The reference view is not moved and
/// has the gain 1, so its true disparity stays true. A view's random numbers depend on the seed and on its
/// position in the grid, not on the other views.
/// @throw InputError if the views are not of 8 bits
LightField photograph(const LightField& light_field, const CameraModel& model = {});

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_CAMERA_MODEL_H
