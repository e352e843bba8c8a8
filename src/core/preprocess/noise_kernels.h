#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_KERNELS_H

#include <cstdint>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The inner loop of the noise estimate: for each byte of a row but those of the first and the last pixel,
/// the sums of the brightness and of the absolute response of the mask [1 -2 1]^T [1 -2 1] over the rows
/// [top, bottom) of an 8-bit image, with the best vector instructions that the processor has.
/// @param top at least 1
/// @param bottom less than the number of rows, and at most 32 more than top
/// @param response, level as many words as a row has bytes
void sumMaskResponses(const cv::Mat& image, int top, int bottom, std::uint16_t* response,
                      std::uint16_t* level);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_KERNELS_H
