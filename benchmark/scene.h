#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_SCENE_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_SCENE_H

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::benchmark
{
/// A light field whose disparity is known.
struct Scene
{
  std::string name;
  LightField light_field;
  cv::Mat truth;  ///< CV_32FC1, of the reference view
};

/// @throw InputError if the folder holds no light field or no truth
Scene readScene(const std::filesystem::path& folder, int threads);

/// The range of a true disparity map.
DisparityRange rangeOf(const cv::Mat& truth);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_SCENE_H
