#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_CHART_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_CHART_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth::benchmark
{
/// One value with its spread.
struct ChartPoint
{
  double x = 0.0;
  double y = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
};

/// A power law, y = factor * x ^ exponent.
struct PowerLaw
{
  double factor = 1.0;
  double exponent = 1.0;
};

/// The least-squares line through the logarithms. @pre at least two different x, all x and y positive
PowerLaw fitPowerLaw(const std::vector<ChartPoint>& points);

/// Points on two logarithmic axes with their spread, and the line that was fitted to them.
struct Chart
{
  std::string title;
  std::string x_name;
  std::string y_name;
  std::vector<ChartPoint> points;
  PowerLaw fit;
};

/// Draws charts two in a row. @return CV_8UC3
cv::Mat drawCharts(const std::vector<Chart>& charts);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_CHART_H
