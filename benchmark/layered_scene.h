#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H

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

/// A textured wall with textured discs in front of it at several depths, seen by 8-bit colour views at the
/// positions of gridOf() or crossOf(), which are spread over the same baseline however many they are; the
/// same scene in any size. For measurements of time that need arrays and sizes which no data set has.
LightField layeredScene(const cv::Size& size, const std::vector<GridPosition>& positions);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_LAYERED_SCENE_H
