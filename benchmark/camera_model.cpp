#include "camera_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::benchmark
{
namespace
{
/// Light in 0..1 of a value in 0..1, and the inverse, as sRGB has them (IEC 61966-2-1).
double toLight(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double fromLight(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

constexpr int RAW_LEVELS = 65536;

cv::Mat linearLight(const cv::Mat& image)
{
  cv::Mat table(1, 256, CV_32FC1);
  for (int level = 0; level < table.cols; ++level)
  {
    table.at<float>(level) = static_cast<float>(toLight(level / 255.0));
  }
  cv::Mat light;
  cv::LUT(image, table, light);
  return light;
}

/// 8-bit levels of a raw image of 16 bits.
cv::Mat developed(const cv::Mat& raw)
{
  static const std::vector<std::uint8_t> levels = []
  {
    std::vector<std::uint8_t> table(RAW_LEVELS);
    for (int value = 0; value < RAW_LEVELS; ++value)
    {
      table[static_cast<std::size_t>(value)] =
          cv::saturate_cast<std::uint8_t>(255.0 * fromLight(value / (RAW_LEVELS - 1.0)));
    }
    return table;
  }();
  cv::Mat image(raw.size(), CV_MAKETYPE(CV_8U, raw.channels()));
  for (int y = 0; y < raw.rows; ++y)
  {
    const auto* const from = raw.ptr<std::uint16_t>(y);
    std::transform(from, from + raw.cols * raw.channels(), image.ptr<std::uint8_t>(y),
                   [](std::uint16_t value) { return levels[value]; });
  }
  return image;
}

/// One view being taken.
class Exposure
{
public:
  Exposure(const CameraModel& model, const View& view, bool is_reference)
      : model_(model), random_(seedOf(model, view.grid)), is_reference_(is_reference)
  {
  }

  cv::Mat take(const cv::Mat& image)
  {
    // In this order whatever is switched off, so that parts can be compared.
    const cv::Point2d shift(random_.gaussian(model_.shift_px), random_.gaussian(model_.shift_px));
    const double roll = random_.gaussian(model_.roll_degrees);
    const double gain = 1.0 + random_.gaussian(model_.gain);
    cv::Mat light = linearLight(image);
    if (!is_reference_)
    {
      move(shift, roll, light);
      light *= gain;
    }
    if (model_.blur_px > 0.0)
    {
      cv::GaussianBlur(light, light, {}, model_.blur_px);
    }
    return compress(developed(read(light)));
  }

private:
  static std::uint64_t seedOf(const CameraModel& model, const GridPosition& grid)
  {
    constexpr std::uint64_t scatter = 0x9E3779B97F4A7C15U;  // neighbours get numbers that are far apart
    const auto position = static_cast<std::uint64_t>(grid.row * 1000 + grid.column);
    return (model.seed * 1000003U + position + 1U) * scatter;
  }

  void move(const cv::Point2d& shift, double roll, cv::Mat& light) const
  {
    if (shift == cv::Point2d() && roll == 0.0)
    {
      return;
    }
    const cv::Point2f middle(0.5F * static_cast<float>(light.cols - 1),
                             0.5F * static_cast<float>(light.rows - 1));
    cv::Mat matrix = cv::getRotationMatrix2D(middle, roll, 1.0);
    matrix.at<double>(0, 2) += shift.x;
    matrix.at<double>(1, 2) += shift.y;
    cv::warpAffine(light.clone(), light, matrix, light.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  }

  /// What the sensor gives, 16 bits, all colours of each pixel interpolated.
  cv::Mat read(const cv::Mat& light)
  {
    const bool mosaic = model_.mosaic && light.channels() == 3;
    cv::Mat values = mosaic ? behindFilters(light) : light;
    if (model_.full_well > 0.0)
    {
      addNoise(values);
    }
    cv::Mat raw;
    values.convertTo(raw, CV_16U, RAW_LEVELS - 1.0);
    if (mosaic)
    {
      cv::cvtColor(raw, raw, cv::COLOR_BayerBG2BGR_EA);  // OpenCV's name for RGGB
    }
    return raw;
  }

  static cv::Mat behindFilters(const cv::Mat& light)
  {
    constexpr std::array<int, 4> channels = {2, 1, 1, 0};  // RGGB of BGR
    cv::Mat mosaic(light.size(), CV_32FC1);
    for (int y = 0; y < light.rows; ++y)
    {
      for (int x = 0; x < light.cols; ++x)
      {
        mosaic.at<float>(y, x) =
            light.at<cv::Vec3f>(y, x)[channels[static_cast<std::size_t>(y % 2 * 2 + x % 2)]];
      }
    }
    return mosaic;
  }

  /// Photons arrive by Poisson's law, here its Gaussian: at the few electrons where the two differ the noise
  /// of reading hides it.
  void addNoise(cv::Mat& values)
  {
    cv::Mat noise(values.size(), values.type());
    random_.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    const auto well = static_cast<float>(model_.full_well);
    const auto read_variance = static_cast<float>(model_.read_noise * model_.read_noise);
    for (int y = 0; y < values.rows; ++y)
    {
      auto* const value = values.ptr<float>(y);
      const auto* const normal = noise.ptr<float>(y);
      for (int i = 0; i < values.cols * values.channels(); ++i)
      {
        const float electrons = std::clamp(value[i], 0.0F, 1.0F) * well;
        value[i] = (electrons + normal[i] * std::sqrt(electrons + read_variance)) / well;
      }
    }
  }

  cv::Mat compress(const cv::Mat& image) const
  {
    if (model_.jpeg_quality == 0)
    {
      return image;
    }
    std::vector<std::uint8_t> coded;
    cv::imencode(".jpg", image, coded, {cv::IMWRITE_JPEG_QUALITY, model_.jpeg_quality});
    return cv::imdecode(coded, cv::IMREAD_UNCHANGED);
  }

  const CameraModel& model_;
  cv::RNG random_;
  bool is_reference_;
};

}  // namespace

LightField photograph(const LightField& light_field, const CameraModel& model)
{
  LightField result = light_field;
  for (const View& view : light_field.views)
  {
    if (view.image.depth() != CV_8U)
    {
      throw InputError("The view at " + toString(view.grid) +
                       " is not of 8 bits; the camera model photographs 8-bit views, use toEightBit().");
    }
  }
  ThreadPool pool;
  pool.parallelFor(0, static_cast<int>(result.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       const View& view = light_field.views[i];
                       Exposure exposure(model, view, i == light_field.reference_index);
                       result.views[i].image = exposure.take(view.image);
                     }
                   });
  return result;
}

}  // namespace light_field_depth::benchmark
