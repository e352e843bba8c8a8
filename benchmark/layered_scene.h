#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::benchmark
{
/// Disparities of the scene lie within, in pixels per grid step.
constexpr DisparityRange LAYERED_SCENE_RANGE = {-1.75F, 1.75F};
/// How far the outermost views stand from the reference along rows and columns, in steps.
constexpr double LAYERED_SCENE_BASELINE = 4.0;

/// All positions of a grid of size x size views, or those of the cross through its middle. @param size odd
std::vector<GridPosition> gridOf(int size);
std::vector<GridPosition> crossOf(int size);

/// A textured wall with textured discs in front of it at several depths; the same scene in any size. All of
/// it moves, each disc in a direction of its own. For measurements that need arrays, sizes and videos which
/// no data set has.
class LayeredScene
{
public:
  explicit LayeredScene(const cv::Size& size, std::uint64_t seed = 1);

  /// 8-bit colour views at the positions of gridOf() or crossOf(), which are spread over the same baseline
  /// however many they are. @param time in frames of a video
  LightField views(const std::vector<GridPosition>& positions, double time = 0.0) const;

  /// CV_32FC1, the exact disparity of the reference view.
  cv::Mat truth(double time = 0.0) const;

private:
  struct Layer
  {
    double disparity = 0.0;  ///< at the time 0
    cv::Point2d motion_px;   ///< in one frame
    cv::Mat texture;         ///< as the reference view sees it at the time 0
    cv::Mat mask;            ///< empty: everywhere

    double disparityAt(double time) const;
  };
  cv::Mat render(const cv::Point2d& steps, double time) const;

  std::vector<Layer> layers_;  // from the farthest to the nearest
};

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H
