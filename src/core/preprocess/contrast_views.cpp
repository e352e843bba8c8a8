#include "core/preprocess/contrast_views.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// The reduced views have at least this many pixels on their longer side (if the views have them), and less
/// than twice as many: enough for the moves of a plenoptic camera, few enough to be quick.
constexpr int CONTRAST_SIDE_PX = 96;
/// A band of frequencies (difference of Gaussians): without the noise of single pixels, and without the slow
/// changes that exposure and shading make. Set by hand.
constexpr double NOISE_SIGMA_PX = 0.8;
constexpr double SURROUND_SIGMA_PX = 4.0;
/// Contrast of this many grey levels counts half: less is noise.
constexpr float FLAT_CONTRAST = 2.0F;
constexpr double FULL_SCALE = 255.0;  // of 8 bits

/// From the values of a view to those of 8 bits.
struct Stretch
{
  double factor = 1.0;
  double shift = 0.0;
};

Stretch stretchOf(const cv::Mat& reference)
{
  Stretch stretch;
  if (reference.depth() != CV_8U)
  {
    double least = 0.0;
    double most = 0.0;
    cv::minMaxIdx(reference.reshape(1), &least, &most);
    stretch.factor = FULL_SCALE / std::max(most - least, 1.0);
    stretch.shift = -least * stretch.factor;
  }
  return stretch;
}

/// CV_32FC1 of the reduced size.
cv::Mat smallGrey(const cv::Mat& image, int halvings, const Stretch& stretch)
{
  const int first = std::min(halvings, 1);
  cv::Mat small;
  if (image.depth() == CV_8U)
  {
    small = halve(toGrey(halve(image, first)), halvings - first);
  }
  else
  {
    cv::resize(toGrey(image), small, {image.cols >> halvings, image.rows >> halvings}, 0, 0, cv::INTER_AREA);
  }
  cv::Mat values;
  small.convertTo(values, CV_32F, stretch.factor, stretch.shift);
  return values;
}

cv::Mat contrastOf(const cv::Mat& grey)
{
  cv::Mat smooth;
  cv::Mat surround;
  cv::GaussianBlur(grey, smooth, {0, 0}, NOISE_SIGMA_PX);
  cv::GaussianBlur(grey, surround, {0, 0}, SURROUND_SIGMA_PX);
  const cv::Mat detail = smooth - surround;
  cv::Mat energy;
  cv::GaussianBlur(detail.mul(detail), energy, {0, 0}, SURROUND_SIGMA_PX);
  cv::Mat contrast(grey.size(), CV_32FC1);
  for (int y = 0; y < grey.rows; ++y)
  {
    const auto* const detail_row = detail.ptr<float>(y);
    const auto* const energy_row = energy.ptr<float>(y);
    auto* const row = contrast.ptr<float>(y);
    for (int x = 0; x < grey.cols; ++x)
    {
      row[x] = detail_row[x] / (std::sqrt(energy_row[x]) + FLAT_CONTRAST);
    }
  }
  return contrast;
}

}  // namespace

int contrastReduction(const cv::Size& size)
{
  return 1 << halvingsFor(size, CONTRAST_SIDE_PX);
}

std::vector<ContrastView> contrastViews(const LightField& light_field,
                                        const std::vector<std::size_t>& indices, ThreadPool& pool)
{
  const int halvings = halvingsFor(light_field.size(), CONTRAST_SIDE_PX);
  const auto scale = static_cast<float>(std::ldexp(1.0, -halvings));
  const Stretch stretch = stretchOf(light_field.reference().image);
  std::vector<ContrastView> views(indices.size());
  pool.parallelFor(0, static_cast<int>(indices.size()), 1,
                   [&](int first, int last)
                   {
                     for (int i = first; i < last; ++i)
                     {
                       ContrastView& view = views[static_cast<std::size_t>(i)];
                       view.index = indices[static_cast<std::size_t>(i)];
                       const View& source = light_field.views[view.index];
                       view.image = contrastOf(smallGrey(source.image, halvings, stretch));
                       view.steps = cv::Point2f(source.steps) * scale;
                       view.offset = cv::Point2f(source.offset_px) * scale;
                     }
                   });
  return views;
}

cv::Mat shiftedBack(const ContrastView& view)
{
  constexpr float NEGLIGIBLE_PX = 0.01F;  // a hundredth of what tells two displacements apart
  if (std::abs(view.offset.x) < NEGLIGIBLE_PX && std::abs(view.offset.y) < NEGLIGIBLE_PX)
  {
    return view.image;
  }
  const cv::Matx23f motion(1, 0, view.offset.x, 0, 1, view.offset.y);
  cv::Mat image;
  cv::warpAffine(view.image, image, motion, view.image.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  return image;
}

bool sampleContrast(const cv::Mat& image, float x, float y, float& value)
{
  const auto left = static_cast<int>(std::floor(x));
  const auto top = static_cast<int>(std::floor(y));
  if (left < 0 || top < 0 || left + 1 >= image.cols || top + 1 >= image.rows)
  {
    return false;
  }
  const float fx = x - static_cast<float>(left);
  const float fy = y - static_cast<float>(top);
  const auto* const upper = image.ptr<float>(top) + left;
  const auto* const lower = image.ptr<float>(top + 1) + left;
  value = (1 - fy) * ((1 - fx) * upper[0] + fx * upper[1]) + fy * ((1 - fx) * lower[0] + fx * lower[1]);
  return true;
}

}  // namespace light_field_depth
