#ifndef LIGHT_FIELD_DEPTH_CORE_NOISE_ESTIMATE_H
#define LIGHT_FIELD_DEPTH_CORE_NOISE_ESTIMATE_H

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Standard deviation of the noise of one image in 8-bit units, the mean over its channels, without the noise
/// that rounding to bytes makes by itself.
///
/// A mask that answers neither to constant brightness nor to gradients nor to edges along the axes measures
/// what is left of the image (J. Immerkaer, "Fast noise variance estimation", 1996). Here its response is
/// averaged in small blocks, and the calmest tenth of the blocks tells the noise, so that texture does not
/// count. Blocks that are nearly black or white are left out where others exist, since noise is cut off
/// there.
///
/// Within a fifth for white noise of 1 to 10 grey levels, if a tenth of the image is without fine texture.
/// Noise that is correlated from pixel to pixel (after demosaicing or compression) is taken for less than it
/// is. About 0.1 ms for 512 x 512 pixels in colour.
/// @param image CV_8UC1 or CV_8UC3, at least 16 x 16; see toEightBit()
/// @return 0 for an image without noise. Thread safe.
/// @throw InputError for an image of another type or size
float estimateNoise(const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_NOISE_ESTIMATE_H
