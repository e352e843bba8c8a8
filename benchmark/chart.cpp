#include "chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "report_files.h"

namespace light_field_depth::benchmark
{
namespace
{
const cv::Size CHART_SIZE(620, 460);
const cv::Rect PLOT(90, 50, 500, 340);
const cv::Scalar INK(60, 60, 60);
const cv::Scalar GRID(225, 225, 225);
const cv::Scalar DOT(160, 90, 20);
const cv::Scalar LINE(60, 120, 230);
constexpr double MARGIN = 1.25;  // free space on either side of the values, as a factor
constexpr double TEXT_SCALE = 0.5;

enum class Align
{
  Left,
  Centre,
  Right
};

void write(cv::Mat& image, const std::string& text, const cv::Point& at, Align align,
           double scale = TEXT_SCALE)
{
  int baseline = 0;
  const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline).width;
  const int shift = align == Align::Left ? 0 : align == Align::Centre ? width / 2 : width;
  cv::putText(image, text, at - cv::Point(shift, 0), cv::FONT_HERSHEY_SIMPLEX, scale, INK, 1, cv::LINE_AA);
}

/// One logarithmic axis.
struct Axis
{
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;

  void include(double value)
  {
    low = std::min(low, value / MARGIN);
    high = std::max(high, value * MARGIN);
  }
  /// 0 at the low end, 1 at the high one.
  double place(double value) const { return std::log(value / low) / std::log(high / low); }
};

/// 1, 2 and 5 times the powers of ten within the axis.
std::vector<double> roundNumbers(const Axis& axis)
{
  std::vector<double> numbers;
  const int last = static_cast<int>(std::floor(std::log10(axis.high)));
  for (int exponent = static_cast<int>(std::floor(std::log10(axis.low))); exponent <= last; ++exponent)
  {
    const double decade = std::pow(10.0, exponent);
    for (const double digit : {1.0, 2.0, 5.0})
    {
      if (digit * decade >= axis.low && digit * decade <= axis.high)
      {
        numbers.push_back(digit * decade);
      }
    }
  }
  return numbers;
}

/// Large numbers in thousands and millions.
std::string shortNumber(double value)
{
  constexpr double thousand = 1e3;
  constexpr double million = 1e6;
  if (value >= million)
  {
    return fixed(value / million, std::fmod(value, million) == 0.0 ? 0 : 1) + " M";
  }
  if (value >= 10.0 * thousand)
  {
    return fixed(value / thousand, 0) + " k";
  }
  return fixed(value, value < 1.0 ? 1 : 0);
}

class Plotter
{
public:
  Plotter(const Chart& chart, cv::Mat image) : chart_(chart), image_(std::move(image))
  {
    for (const ChartPoint& point : chart.points)
    {
      x_axis_.include(point.x);
      y_axis_.include(point.lowest);
      y_axis_.include(point.highest);
    }
  }

  void draw()
  {
    drawAxes();
    drawFit();
    for (const ChartPoint& point : chart_.points)
    {
      cv::line(image_, at(point.x, point.lowest), at(point.x, point.highest), DOT, 1, cv::LINE_AA);
      cv::circle(image_, at(point.x, point.y), 4, DOT, cv::FILLED, cv::LINE_AA);
    }
    write(image_, chart_.title + ": exponent " + fixed(chart_.fit.exponent, 2), {PLOT.x, PLOT.y - 18},
          Align::Left, 0.6);
  }

private:
  cv::Point at(double x, double y) const
  {
    return {PLOT.x + cvRound(x_axis_.place(x) * PLOT.width),
            PLOT.y + cvRound((1.0 - y_axis_.place(y)) * PLOT.height)};
  }

  void drawAxes()
  {
    for (const double x : roundNumbers(x_axis_))
    {
      const cv::Point foot = at(x, y_axis_.low);
      cv::line(image_, foot, {foot.x, PLOT.y}, GRID, 1);
      write(image_, shortNumber(x), foot + cv::Point(0, 20), Align::Centre);
    }
    for (const double y : roundNumbers(y_axis_))
    {
      const cv::Point foot = at(x_axis_.low, y);
      cv::line(image_, foot, {PLOT.x + PLOT.width, foot.y}, GRID, 1);
      write(image_, shortNumber(y), foot + cv::Point(-8, 5), Align::Right);
    }
    cv::rectangle(image_, PLOT, INK, 1);
    write(image_, chart_.x_name, {PLOT.x + PLOT.width / 2, PLOT.y + PLOT.height + 45}, Align::Centre);
    write(image_, chart_.y_name, {PLOT.x - 8, PLOT.y - 18}, Align::Right);
  }

  void drawFit()
  {
    const auto value = [&](double x) { return chart_.fit.factor * std::pow(x, chart_.fit.exponent); };
    const double first = chart_.points.front().x;
    const double last = chart_.points.back().x;
    cv::Mat plot = image_(PLOT);
    cv::line(plot, at(first, value(first)) - PLOT.tl(), at(last, value(last)) - PLOT.tl(), LINE, 2,
             cv::LINE_AA);
  }

  const Chart& chart_;
  cv::Mat image_;
  Axis x_axis_;
  Axis y_axis_;
};

}  // namespace

PowerLaw fitPowerLaw(const std::vector<ChartPoint>& points)
{
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const ChartPoint& point : points)
  {
    mean_x += std::log(point.x) / static_cast<double>(points.size());
    mean_y += std::log(point.y) / static_cast<double>(points.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const ChartPoint& point : points)
  {
    const double x = std::log(point.x) - mean_x;
    covariance += x * (std::log(point.y) - mean_y);
    variance += x * x;
  }
  const double exponent = covariance / variance;
  return {std::exp(mean_y - exponent * mean_x), exponent};
}

cv::Mat drawCharts(const std::vector<Chart>& charts)
{
  constexpr int in_a_row = 2;
  const int rows = (static_cast<int>(charts.size()) + in_a_row - 1) / in_a_row;
  cv::Mat image(CHART_SIZE.height * rows, CHART_SIZE.width * in_a_row, CV_8UC3, cv::Scalar::all(255.0));
  for (int i = 0; i < static_cast<int>(charts.size()); ++i)
  {
    const cv::Point corner(i % in_a_row * CHART_SIZE.width, i / in_a_row * CHART_SIZE.height);
    Plotter(charts[static_cast<std::size_t>(i)], image(cv::Rect(corner, CHART_SIZE))).draw();
  }
  return image;
}

}  // namespace light_field_depth::benchmark
