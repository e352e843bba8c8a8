#include "core/paper2017/dense_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <opencv2/imgproc.hpp>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace light_field_depth
{
namespace
{
constexpr int BINS = DescriptorImage::ORIENTATIONS;
/// Offset of the first cell from the pixel of its descriptor; the last is as far on the other side.
constexpr int FIRST_CELL_PX = 3;
constexpr int PATCH_SIDE_PX = DescriptorImage::CELLS_PER_SIDE * DescriptorImage::CELL_SPACING_PX;
/// Added to the norm of a patch, in grey levels of gradient: below it a patch counts as flat, so that its
/// noise is not blown up.
constexpr float NORM_FLOOR = 4.0F;
/// Squared gradients, in grey levels, that count as none: the share of the centre in a flat patch is 1.
constexpr double CENTRE_ENERGY_FLOOR = 10.0;
/// Turns normalised histograms into bytes. A patch of one orientation has 0.25 in all of its 16 cells.
constexpr float BYTE_SCALE = 510.0F;

/// Central differences of the channel whose gradient is the largest, in grey levels per pixel.
void gradientRow(const cv::Mat& image, int y, std::vector<float>& gx, std::vector<float>& gy)
{
  const int channels = image.channels();
  const int last = image.cols - 1;
  const std::uint8_t* row = image.ptr<std::uint8_t>(y);
  const std::uint8_t* above = image.ptr<std::uint8_t>(std::max(0, y - 1));
  const std::uint8_t* below = image.ptr<std::uint8_t>(std::min(image.rows - 1, y + 1));
  for (int x = 0; x <= last; ++x)
  {
    const int left = std::max(0, x - 1) * channels;
    const int right = std::min(last, x + 1) * channels;
    int best = -1;
    for (int c = 0; c < channels; ++c)
    {
      const int dx = row[right + c] - row[left + c];
      const int dy = below[x * channels + c] - above[x * channels + c];
      const int magnitude = dx * dx + dy * dy;
      if (magnitude > best)
      {
        best = magnitude;
        gx[static_cast<std::size_t>(x)] = 0.5F * static_cast<float>(dx);
        gy[static_cast<std::size_t>(x)] = 0.5F * static_cast<float>(dy);
      }
    }
  }
}

/// Spreads a gradient over the bins by the third power of the cosine to each bin's direction.
void orientationRow(const std::vector<float>& gx, const std::vector<float>& gy, float* bins)
{
  /// cos 45 degrees.
  constexpr float DIAGONAL = 0.70710678F;
  /// Against a division by zero where there is no gradient; far below that of a single grey level.
  constexpr float TINY = 1e-6F;
  const auto cube = [](float value) { return value * value * value; };
  for (std::size_t x = 0; x < gx.size(); ++x)
  {
    const float scale = 1.0F / (gx[x] * gx[x] + gy[x] * gy[x] + TINY);
    const std::array<float, 4> along = {gx[x], DIAGONAL * (gx[x] + gy[x]), gy[x], DIAGONAL * (gy[x] - gx[x])};
    float* out = bins + x * BINS;
    for (std::size_t b = 0; b < 4; ++b)
    {
      out[b] = cube(std::max(0.0F, along[b])) * scale;
      out[b + 4] = cube(std::max(0.0F, -along[b])) * scale;
    }
  }
}

/// CV_32FC(8): each pixel's gradient, spread over the orientations.
cv::Mat orientationImage(const cv::Mat& image)
{
  cv::Mat bins(image.size(), CV_32FC(BINS));
  std::vector<float> gx(static_cast<std::size_t>(image.cols));
  std::vector<float> gy(gx.size());
  for (int y = 0; y < image.rows; ++y)
  {
    gradientRow(image, y, gx, gy);
    orientationRow(gx, gy, bins.ptr<float>(y));
  }
  return bins;
}

/// Weights 1 2 1 over four: bilinear sharing of a gradient among cells that are 2 px apart.
void smoothAcrossRows(const cv::Mat& bins, int y, std::vector<float>& out)
{
  const float* above = bins.ptr<float>(std::max(0, y - 1));
  const float* row = bins.ptr<float>(y);
  const float* below = bins.ptr<float>(std::min(bins.rows - 1, y + 1));
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    out[i] = 0.25F * (above[i] + below[i]) + 0.5F * row[i];
  }
}

void smoothAlongRow(const std::vector<float>& in, float* out, float* energy)
{
  const int last = static_cast<int>(in.size()) / BINS - 1;
  for (int x = 0; x <= last; ++x)
  {
    const float* left = in.data() + std::max(0, x - 1) * BINS;
    const float* middle = in.data() + x * BINS;
    const float* right = in.data() + std::min(last, x + 1) * BINS;
    float sum = 0.0F;
    for (int b = 0; b < BINS; ++b)
    {
      const float value = 0.25F * (left[b] + right[b]) + 0.5F * middle[b];
      out[x * BINS + b] = value;
      sum += value * value;
    }
    energy[x] = sum;
  }
}

cv::Mat normalizedBytes(const cv::Mat& cells, const cv::Mat& mean_energy)
{
  constexpr float CELL_COUNT = DescriptorImage::CELLS_PER_SIDE * DescriptorImage::CELLS_PER_SIDE;
  cv::Mat bytes(cells.size(), CV_8UC(BINS));
  for (int y = 0; y < cells.rows; ++y)
  {
    const float* in = cells.ptr<float>(y);
    const float* energies = mean_energy.ptr<float>(y);
    std::uint8_t* out = bytes.ptr<std::uint8_t>(y);
    for (int x = 0; x < cells.cols; ++x)
    {
      const float scale = BYTE_SCALE / (std::sqrt(CELL_COUNT * std::max(0.0F, energies[x])) + NORM_FLOOR);
      for (int b = 0; b < BINS; ++b)
      {
        out[x * BINS + b] = static_cast<std::uint8_t>(std::min(255.0F, in[x * BINS + b] * scale + 0.5F));
      }
    }
  }
  return bytes;
}

/// The ratio is squared, which measured better than the plain one.
cv::Mat centreShareOf(const cv::Mat& energy, const cv::Mat& mean_energy)
{
  cv::Mat share = (energy + CENTRE_ENERGY_FLOOR) / (mean_energy + CENTRE_ENERGY_FLOOR);
  cv::min(share, 1.0, share);
  return share.mul(share);
}

}  // namespace

DescriptorImage::DescriptorImage(const cv::Mat& image) : size_(image.size())
{
  const cv::Mat bins = orientationImage(image);
  cv::Mat cells(image.size(), CV_32FC(BINS));
  cv::Mat energy(image.size(), CV_32FC1);
  std::vector<float> smoothed(static_cast<std::size_t>(image.cols) * BINS);
  for (int y = 0; y < image.rows; ++y)
  {
    smoothAcrossRows(bins, y, smoothed);
    smoothAlongRow(smoothed, cells.ptr<float>(y), energy.ptr<float>(y));
  }
  cv::Mat mean_energy;
  cv::boxFilter(energy, mean_energy, CV_32F, {PATCH_SIDE_PX + 1, PATCH_SIDE_PX + 1}, {-1, -1}, true,
                cv::BORDER_REPLICATE);
  centre_share_ = centreShareOf(energy, mean_energy);
  const cv::Mat bytes = normalizedBytes(cells, mean_energy);
  cv::copyMakeBorder(bytes, histograms_, FIRST_CELL_PX, FIRST_CELL_PX, FIRST_CELL_PX, FIRST_CELL_PX,
                     cv::BORDER_REPLICATE);
}

int descriptorDistance(const std::uint8_t* a, std::size_t stride_a, const std::uint8_t* b,
                       std::size_t stride_b)
{
  constexpr std::size_t CELL_STEP = DescriptorImage::CELL_SPACING_PX * DescriptorImage::ORIENTATIONS;
#if defined(__SSE2__)
  const auto two_cells = [](const std::uint8_t* cell)
  {
    const auto* low = reinterpret_cast<const __m128i*>(cell);
    const auto* high = reinterpret_cast<const __m128i*>(cell + CELL_STEP);
    return _mm_unpacklo_epi64(_mm_loadl_epi64(low), _mm_loadl_epi64(high));
  };
  __m128i sum = _mm_setzero_si128();
  for (int row = 0; row < DescriptorImage::CELLS_PER_SIDE; ++row)
  {
    sum = _mm_add_epi32(sum, _mm_sad_epu8(two_cells(a), two_cells(b)));
    sum = _mm_add_epi32(sum, _mm_sad_epu8(two_cells(a + 2 * CELL_STEP), two_cells(b + 2 * CELL_STEP)));
    a += DescriptorImage::CELL_SPACING_PX * stride_a;
    b += DescriptorImage::CELL_SPACING_PX * stride_b;
  }
  return _mm_cvtsi128_si32(_mm_add_epi32(sum, _mm_srli_si128(sum, 8)));
#else
  int sum = 0;
  for (int row = 0; row < DescriptorImage::CELLS_PER_SIDE; ++row)
  {
    for (std::size_t cell = 0; cell < DescriptorImage::CELLS_PER_SIDE * CELL_STEP; cell += CELL_STEP)
    {
      for (std::size_t bin = 0; bin < DescriptorImage::ORIENTATIONS; ++bin)
      {
        sum += std::abs(static_cast<int>(a[cell + bin]) - static_cast<int>(b[cell + bin]));
      }
    }
    a += DescriptorImage::CELL_SPACING_PX * stride_a;
    b += DescriptorImage::CELL_SPACING_PX * stride_b;
  }
  return sum;
#endif
}

std::vector<DescriptorImage> descriptorPyramid(const cv::Mat& image, int levels, double ratio)
{
  std::vector<DescriptorImage> pyramid;
  pyramid.reserve(static_cast<std::size_t>(levels));
  cv::Mat level = image;
  for (int i = 0; i < levels; ++i)
  {
    pyramid.emplace_back(level);
    if (i + 1 < levels)
    {
      const double scale = std::pow(ratio, i + 1);
      const cv::Size size(std::max(1, cvRound(image.cols * scale)), std::max(1, cvRound(image.rows * scale)));
      cv::Mat smaller;
      cv::resize(level, smaller, size, 0, 0, cv::INTER_AREA);
      level = smaller;
    }
  }
  return pyramid;
}

int usablePyramidLevels(const cv::Size& size, int levels, double ratio, int min_side_px)
{
  int usable = 1;
  double side = std::min(size.width, size.height) * ratio;
  while (usable < levels && side >= min_side_px)
  {
    ++usable;
    side *= ratio;
  }
  return usable;
}

}  // namespace light_field_depth
