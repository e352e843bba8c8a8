#include "ros/array_baseline.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
std::string number(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

/// One axis of the grid: how to read a row (column) index and a position on it.
struct Axis
{
  int GridPosition::*along;
  int GridPosition::*across;
  double cv::Point2d::*metres;
  const char* index_name;
  const char* entry_name;
  const char* remedy;
};
constexpr Axis COLUMNS = {&GridPosition::column, &GridPosition::row,  &cv::Point2d::x, "column",
                          "-P[3] / P[0]",        "from left to right"};
constexpr Axis ROWS = {&GridPosition::row, &GridPosition::column, &cv::Point2d::y, "row",
                       "-P[7] / P[5]",     "from top to bottom"};

/// Metres for one step of the grid, between each view and the next one on its line.
/// @throw InputError for two neighbours in the wrong order
std::vector<double> neighbourSteps(const std::vector<GridPosition>& grid,
                                   const std::vector<cv::Point2d>& positions, const Axis& axis)
{
  std::vector<std::size_t> order(grid.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b)
            {
              return grid[a].*axis.across != grid[b].*axis.across
                         ? grid[a].*axis.across < grid[b].*axis.across
                         : grid[a].*axis.along < grid[b].*axis.along;
            });
  std::vector<double> steps;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    const GridPosition& before = grid[order[i - 1]];
    const GridPosition& after = grid[order[i]];
    if (before.*axis.across != after.*axis.across)
    {
      continue;
    }
    const double from_m = positions[order[i - 1]].*axis.metres;
    const double to_m = positions[order[i]].*axis.metres;
    if (to_m <= from_m)
    {
      throw InputError("View " + toString(after) + ": " + axis.entry_name +
                       " of its CameraInfo places it at " + number(to_m) + " m, but view " +
                       toString(before) + ", whose " + axis.index_name + " is lower, stands at " +
                       number(from_m) + " m; number the " + axis.index_name + "s of the array " +
                       axis.remedy + ", or correct P.");
    }
    steps.push_back((to_m - from_m) / (after.*axis.along - before.*axis.along));
  }
  return steps;
}

std::optional<double> median(std::vector<double> values)
{
  if (values.empty())
  {
    return std::nullopt;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double adjacentBaseline(const std::vector<GridPosition>& grid, const std::vector<cv::Point2d>& positions)
{
  const std::optional<double> in_rows = median(neighbourSteps(grid, positions, COLUMNS));
  const std::optional<double> in_columns = rowBaseline(grid, positions);
  if (in_rows || in_columns)
  {
    return in_rows ? *in_rows : *in_columns;
  }
  throw InputError("No two of the " + std::to_string(grid.size()) +
                   " views share a row or a column; name views that stand side by side.");
}

std::optional<double> rowBaseline(const std::vector<GridPosition>& grid,
                                  const std::vector<cv::Point2d>& positions)
{
  return median(neighbourSteps(grid, positions, ROWS));
}

}  // namespace light_field_depth
