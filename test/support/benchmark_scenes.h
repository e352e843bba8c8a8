#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_BENCHMARK_SCENES_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_BENCHMARK_SCENES_H

#include <filesystem>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth::testing
{
/// Where the scenes of the HCI benchmark are looked for, from the top of the checkout. Tests that want them
/// are skipped where they are not.
inline const std::filesystem::path BENCHMARK_SCENES = "../shared/data/hci";

struct BenchmarkScene
{
  LightField light_field;  ///< 9 x 9 views
  cv::Mat truth;           ///< CV_32FC1
};

/// @return nothing if the scene is not there
inline std::optional<BenchmarkScene> readBenchmarkScene(const std::string& name)
{
  if (!std::filesystem::exists(BENCHMARK_SCENES / name))
  {
    return std::nullopt;
  }
  const Dataset dataset = readDataset(BENCHMARK_SCENES / name);
  return BenchmarkScene{dataset.light_field, readPfm(dataset.truth.value())};
}

/// Gaussian noise in every view, the same in every run; sigma in 8-bit units.
inline LightField withNoise(const LightField& light_field, double sigma)
{
  LightField result = light_field;
  cv::RNG random(77);
  for (View& view : result.views)
  {
    cv::Mat values;
    cv::Mat noise(view.image.size(), CV_MAKETYPE(CV_32F, view.image.channels()));
    random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
    view.image.convertTo(values, CV_32F);
    values += noise;
    view.image = cv::Mat();  // the pixels of the other light field stay
    values.convertTo(view.image, CV_8U);
  }
  return result;
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_BENCHMARK_SCENES_H
