#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/preprocess/sweep_kernels.h"
#include "light_field_depth/core/exposure.h"

namespace light_field_depth
{
namespace
{
/// The factors of ViewExposure for each byte of a row: what changes from row to row is a multiple of `gain`.
struct RowFactors
{
  RowFactors(const ViewExposure& exposure, int width, int channels, double half_diagonal)
      : gain(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels)), along_row(gain.size()),
        offset(gain.size())
  {
    std::size_t byte = 0;
    for (int x = 0; x < width; ++x)
    {
      const double u = (x - 0.5 * (width - 1)) / half_diagonal;
      const double shading = 1.0 + u * (exposure.shading[0] + u * exposure.shading[2]);
      for (int channel = 0; channel < channels; ++channel, ++byte)
      {
        gain[byte] = static_cast<float>(exposure.gain[channel]);
        along_row[byte] = static_cast<float>(exposure.gain[channel] * shading);
        offset[byte] = static_cast<float>(exposure.offset[channel]);
      }
    }
  }

  std::vector<float> gain;
  std::vector<float> along_row;
  std::vector<float> offset;
};

/// What ViewExposure::offset and bend make of each level of a channel.
using LevelTable = std::array<float, 256>;

LevelTable levelsOf(const ViewExposure& exposure, int channel)
{
  constexpr double WHITE = 255.0;  // of 8 bits
  LevelTable levels;
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    const auto value = static_cast<double>(level);
    levels[level] =
        static_cast<float>(exposure.offset[channel] + exposure.bend[channel] * value * value / WHITE);
  }
  return levels;
}

/// The same as exposeBytes() with a table for each channel in place of the offset.
void bendBytes(const std::uint8_t* value, const RowFactors& factors, float shading,
               const std::vector<LevelTable>& tables, std::uint8_t* to)
{
  const std::size_t channels = tables.size();
  std::size_t channel = 0;
  for (std::size_t byte = 0; byte < factors.gain.size(); ++byte)
  {
    const float gain = factors.along_row[byte] + shading * factors.gain[byte];
    to[byte] = cv::saturate_cast<std::uint8_t>(static_cast<float>(value[byte]) * gain +
                                               tables[channel][value[byte]]);
    channel = channel + 1 < channels ? channel + 1 : 0;
  }
}

cv::Mat compensated(const cv::Mat& image, const ViewExposure& exposure)
{
  const double half_diagonal = 0.5 * std::hypot(image.cols, image.rows);
  const bool is_bent = exposure.bend != cv::Vec3d();
  std::vector<LevelTable> tables;
  for (int channel = 0; is_bent && channel < image.channels(); ++channel)
  {
    tables.push_back(levelsOf(exposure, channel));
  }
  const RowFactors factors(exposure, image.cols, image.channels(), half_diagonal);
  cv::Mat result(image.size(), image.type());
  for (int y = 0; y < image.rows; ++y)
  {
    const double v = (y - 0.5 * (image.rows - 1)) / half_diagonal;
    const double shading = v * (exposure.shading[1] + v * exposure.shading[2]);
    if (is_bent)
    {
      bendBytes(image.ptr<std::uint8_t>(y), factors, static_cast<float>(shading), tables,
                result.ptr<std::uint8_t>(y));
      continue;
    }
    const ExposureRow row = {factors.along_row.data(), factors.gain.data(), factors.offset.data(),
                             static_cast<float>(shading)};
    exposeBytes(image.ptr<std::uint8_t>(y), row, factors.gain.size(), result.ptr<std::uint8_t>(y));
  }
  return result;
}

}  // namespace

LightField compensateExposure(const LightField& light_field, const std::vector<ViewExposure>& exposures,
                              ThreadPool& pool)
{
  LightField result = light_field;
  pool.parallelFor(0, static_cast<int>(exposures.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       if (exposures[i].differs)
                       {
                         result.views[i].image = compensated(light_field.views[i].image, exposures[i]);
                       }
                     }
                   });
  return result;
}

}  // namespace light_field_depth
