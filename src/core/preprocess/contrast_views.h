#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_CONTRAST_VIEWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_CONTRAST_VIEWS_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// A reduced view of which only the local contrast is left, so that exposure and shading do not count.
struct ContrastView
{
  cv::Mat image;          ///< CV_32FC1; about 0 in the mean, about 1 in spread where there is texture
  cv::Point2f steps;      ///< View::steps in pixels of `image` for a disparity of one full-resolution pixel
  cv::Point2f offset;     ///< View::offset_px in pixels of `image`
  std::size_t index = 0;  ///< into LightField::views
};

/// How much smaller than the views their contrast images are, along each side.
int contrastReduction(const cv::Size& size);

/// The views of the given indices, in that order. Views of 16 bits are stretched to what the reference spans.
std::vector<ContrastView> contrastViews(const LightField& light_field,
                                        const std::vector<std::size_t>& indices, ThreadPool& pool);

/// The image of a view without its offset, sharing its pixels where there is none.
cv::Mat shiftedBack(const ContrastView& view);

/// The value between pixels. @return false outside of the image
bool sampleContrast(const cv::Mat& image, float x, float y, float& value);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_CONTRAST_VIEWS_H
