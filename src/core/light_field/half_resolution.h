#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// The light field at half its resolution: each pixel is the mean of 2 x 2. An odd last row or column is left
/// out. Disparities keep their unit, pixels of the full resolution per grid step, since View::steps and
/// View::offset_px are halved. Keeps its memory; the images are overwritten by the next call.
class HalfResolution
{
public:
  /// In grey.
  /// @param light_field 8-bit views of one or three channels, at least 2 x 2 pixels
  const LightField& reduce(const LightField& light_field, ThreadPool& pool);

  /// The same with the channels that the views have.
  const LightField& reduceInColour(const LightField& light_field, ThreadPool& pool);

private:
  using HalveImage = void (*)(const cv::Mat& image, cv::Mat& half);
  const LightField& reduceWith(HalveImage halve_image, const LightField& light_field, ThreadPool& pool);

  LightField half_;
};

/// Half the size, with all channels, of an 8-bit image of one or three channels. An odd last row or column is
/// left out.
/// @param half may have the memory of an earlier result, but not that of the image
void halveChannels(const cv::Mat& image, cv::Mat& half);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_H
