// The whole estimator on small light fields with any positions, offsets, sizes, types and ranges.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <opencv2/core.hpp>

#include "fuzz/byte_source.h"
#include "fuzz/harnesses.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"

namespace light_field_depth::fuzz
{
namespace
{
void require(bool condition, const char* what)
{
  if (!condition)
  {
    std::fprintf(stderr, "The result is wrong: %s.\n", what);
    std::abort();
  }
}

enum class Texture
{
  Noise,
  Moved,  ///< one texture, moved from view to view
  Flat,
  Stripes,
  COUNT
};

cv::Mat image(Texture texture, const cv::Size& size, int type, int seed, int shift)
{
  cv::Mat values(size, type);
  const double most = CV_MAT_DEPTH(type) == CV_8U ? 255.0 : 4095.0;
  cv::RNG random(static_cast<std::uint64_t>(texture == Texture::Noise ? seed + 1 : 7));
  cv::Mat wide(size.height, size.width + 64, type);
  random.fill(wide, cv::RNG::UNIFORM, 0.0, most);
  switch (texture)
  {
    case Texture::Flat:
      values.setTo(cv::Scalar::all(seed % 256));
      break;
    case Texture::Stripes:
      for (int x = 0; x < size.width; ++x)
      {
        values.col(x).setTo(cv::Scalar::all((x + shift) / 3 % 2 == 0 ? 0.0 : most));
      }
      break;
    case Texture::Noise:
    case Texture::Moved:
    case Texture::COUNT:
      wide.colRange(32 + shift % 32, 32 + shift % 32 + size.width).copyTo(values);
      break;
  }
  return values;
}

LightField lightField(ByteSource& source)
{
  static constexpr int TYPES[] = {CV_8UC3, CV_8UC1, CV_8UC3, CV_8UC1, CV_16UC1, CV_16UC3, CV_8UC3, CV_32FC1};
  const int type = TYPES[source.below(8)];
  const cv::Size size(15 + source.below(66), 15 + source.below(50));
  const auto texture = static_cast<Texture>(source.below(static_cast<int>(Texture::COUNT)));
  const int count = 1 + source.below(12);
  const int disparity = source.below(7) - 3;
  const bool on_grid = source.flag();
  std::vector<View> views;
  for (int i = 0; i < count; ++i)
  {
    // One place for each view, mostly: others are refused at once.
    const bool anywhere = source.below(32) == 31;
    const int row = anywhere ? source.below(3) : i / 3;
    const int column = anywhere ? source.below(4) : i % 3;
    View view = gridView(row, column, image(texture, size, type, i, 16 + disparity * column));
    if (!on_grid)
    {
      view.steps = {source.number(), source.number()};
      view.offset_px = {source.number(), source.number()};
    }
    views.push_back(view);
  }
  std::optional<Calibration> calibration;
  if (source.flag())
  {
    calibration = Calibration();
    calibration->focal_length_px = std::abs(source.number());
    calibration->baseline_m = std::abs(source.number());
    calibration->principal_point_px = {source.number(), source.number()};
    calibration->disparity_offset_px = source.number();
  }
  return makeLightField(views, std::nullopt, calibration);
}

PipelineOptions options(ByteSource& source)
{
  PipelineOptions options;
  const int method = source.below(8);
  options.method = method == 0 ? Method::Paper2017 : Method::Multiview;
  options.multiview.preset = static_cast<MultiviewPreset>(source.below(4));
  options.multiview.registration = source.flag();
  options.views = static_cast<ViewSelection>(source.below(6));
  if (source.flag())
  {
    const auto low = static_cast<float>(source.number());
    options.disparity_range = DisparityRange{low, low + static_cast<float>(std::abs(source.number()))};
  }
  return options;
}

void check(const PipelineResult& result, const cv::Size& size, bool calibrated)
{
  const DisparityEstimate& estimate = result.estimate;
  require(estimate.disparity.size() == size && estimate.confidence.size() == size, "size of the maps");
  require(std::isfinite(estimate.range.min) && std::isfinite(estimate.range.max) &&
              estimate.range.min <= estimate.range.max,
          "range");
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      require(std::isfinite(estimate.disparity.at<float>(y, x)), "a disparity is no number");
      const float confidence = estimate.confidence.at<float>(y, x);
      require(confidence >= 0.0F && confidence <= 1.0F, "a confidence is not between 0 and 1");
      if (calibrated)
      {
        const float depth = result.depth.at<float>(y, x);
        require(std::isnan(depth) || (std::isfinite(depth) && depth > 0.0F),
                "a depth is neither NaN nor positive");
      }
    }
  }
}

}  // namespace

void fuzzEstimator(const std::uint8_t* data, std::size_t size)
{
  ByteSource source(data, size);
  try
  {
    const PipelineOptions settings = options(source);
    ProductRequest request;
    request.depth = true;
    request.organized_cloud = source.flag();
    request.dense_cloud = source.flag();
    const LightField light_field = lightField(source);
    const PipelineResult result = Pipeline(1).run(light_field, settings, request);
    check(result, light_field.size(), light_field.calibration.has_value());
  }
  catch (const InputError& error)
  {
    require(std::string(error.what()).size() > 20, "no sentence");
  }
}

}  // namespace light_field_depth::fuzz
