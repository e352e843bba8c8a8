#ifndef LIGHT_FIELD_DEPTH_SRC_IO_IMAGE_PERIOD_H
#define LIGHT_FIELD_DEPTH_SRC_IO_IMAGE_PERIOD_H

#include <optional>

#include <opencv2/core.hpp>

#include "io/folder_description.h"

namespace light_field_depth
{
/// The part of an image that is a view; a whole image shares its pixels.
/// The image's sides are multiples of the part's grid.
cv::Mat extractPart(const cv::Mat& image, const ViewPart& part);

/// Columns x rows of pixels under one lenslet, if the image is a table of lenslets that begins in its corner:
/// brightness then changes from lenslet to lenslet more than within one.
std::optional<cv::Size> findLenslets(const cv::Mat& image);

/// Columns x rows of views, if the image is a table of equally large views of one scene: it then repeats
/// itself, and has an edge between two views.
std::optional<cv::Size> findTiles(const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_IMAGE_PERIOD_H
