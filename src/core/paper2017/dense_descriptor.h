#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_DESCRIPTOR_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_DESCRIPTOR_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Dense SIFT-like descriptors of one image: 4 x 4 cells, 2 px apart, of 8 gradient orientations around every
/// pixel, 128 numbers of one byte. Neighbouring descriptors share their cells, so only one histogram of
/// 8 bytes is stored for each pixel, normalised by the gradients of the 8 x 8 patch around it: a sixteenth of
/// the memory, and an image of them stays in the cache while its rows are searched.
class DescriptorImage
{
public:
  /// SIFT (Lowe 2004): 4 x 4 cells of 8 orientations; 2 px apart as in CPM (Hu et al. 2016).
  static constexpr int ORIENTATIONS = 8;
  static constexpr int CELLS_PER_SIDE = 4;
  static constexpr int CELL_SPACING_PX = 2;
  /// Sum of absolute differences that no two descriptors exceed.
  static constexpr int MAX_DISTANCE = 255 * ORIENTATIONS * CELLS_PER_SIDE * CELLS_PER_SIDE;

  DescriptorImage() = default;
  /// @param image CV_8UC1 or CV_8UC3 of any size
  explicit DescriptorImage(const cv::Mat& image);

  cv::Size size() const { return size_; }

  /// First cell of the descriptor at a pixel of the image, for descriptorDistance().
  const std::uint8_t* at(int x, int y) const { return histograms_.ptr<std::uint8_t>(y) + x * ORIENTATIONS; }
  /// CV_32FC1, 0..1: how much of the gradients in the descriptor's patch is at its centre, in relation to an
  /// even spread. Where it is small, as beside the edge of an object, the patch matches what is at its rim.
  const cv::Mat& centreShare() const { return centre_share_; }
  /// Bytes from one row to the next.
  std::size_t stride() const { return histograms_.step; }

private:
  cv::Size size_;
  cv::Mat centre_share_;
  cv::Mat histograms_;  ///< CV_8UC(8), the image with a margin in which the patches of border pixels end
};

/// Sum of absolute differences of two descriptors, given by DescriptorImage::at() and stride().
/// 128 bytes a side; about 8 ns.
int descriptorDistance(const std::uint8_t* a, std::size_t stride_a, const std::uint8_t* b,
                       std::size_t stride_b);

/// The descriptors of an image and of its reduced copies, the full size first.
/// @param levels >= 1 @param ratio of one level's sides to those of the level before, in (0, 1)
std::vector<DescriptorImage> descriptorPyramid(const cv::Mat& image, int levels, double ratio);

/// Levels of at least `min_side_px` that an image has, at most `levels`, at least 1.
int usablePyramidLevels(const cv::Size& size, int levels, double ratio, int min_side_px = 16);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_DESCRIPTOR_H
