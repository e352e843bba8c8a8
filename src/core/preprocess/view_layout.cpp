#include "light_field_depth/core/view_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/preprocess/axis_sweep.h"
#include "core/preprocess/contrast_views.h"
#include "core/preprocess/layout_views.h"

namespace light_field_depth
{
namespace
{
/// In pixels of the reduced views: the first holds the moves of camera arrays, the second those of plenoptic
/// cameras, which are fractions of a pixel.
constexpr std::array<Displacements, 2> LABEL_SETS = {{{12.0F, 0.5F}, {2.5F, 0.125F}}};
/// Neighbouring cells agree with each other: each of these blocks has one vote in the significance.
constexpr int BLOCKS_PER_SIDE = 5;

constexpr std::array<GridLayout, 4> LAYOUTS = {{{false, false}, {false, true}, {true, false}, {true, true}}};

/// Costs of the views on the claimed row (horizontal) and column (vertical) of the reference, at each
/// displacement along x and along y. Empty where there are no views.
struct LineCosts
{
  cv::Mat horizontal_x;
  cv::Mat horizontal_y;
  cv::Mat vertical_x;
  cv::Mat vertical_y;
  cv::Size cells;
};

/// One layout's cost in each cell: the least over the displacements, and the mean.
struct LayoutCost
{
  std::vector<float> least;
  double mean_of_least = 0.0;
  double mean = 0.0;
};

void addLabel(const cv::Mat& costs, int label, std::vector<float>& sum)
{
  if (costs.empty())
  {
    return;
  }
  const auto* const row = costs.ptr<float>(label);
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    sum[i] += row[i];
  }
}

LayoutCost costOf(const LineCosts& lines, const GridLayout& layout)
{
  const cv::Mat& horizontal = layout.transposed ? lines.horizontal_y : lines.horizontal_x;
  const cv::Mat& vertical = layout.transposed ? lines.vertical_x : lines.vertical_y;
  const int labels = std::max(horizontal.rows, vertical.rows);
  const int line_count = (horizontal.empty() ? 0 : 1) + (vertical.empty() ? 0 : 1);
  const auto cells = static_cast<std::size_t>(lines.cells.area());
  LayoutCost cost;
  cost.least.assign(cells, std::numeric_limits<float>::max());
  std::vector<float> sum(cells);
  for (int label = 0; label < labels; ++label)
  {
    std::fill(sum.begin(), sum.end(), 0.0F);
    addLabel(horizontal, label, sum);
    addLabel(vertical, layout.mirrored ? labels - 1 - label : label, sum);
    double total = 0.0;
    for (std::size_t i = 0; i < cells; ++i)
    {
      cost.least[i] = std::min(cost.least[i], sum[i]);
      total += sum[i];
    }
    cost.mean += total / (static_cast<double>(cells) * labels * line_count);
  }
  for (float& value : cost.least)
  {
    value /= static_cast<float>(line_count);
    cost.mean_of_least += value / static_cast<double>(cells);
  }
  return cost;
}

/// Mean over its standard error, of the blocks' means of second - best.
double significanceOf(const std::vector<float>& best, const std::vector<float>& second, const cv::Size& cells)
{
  double sum = 0.0;
  double squares = 0.0;
  for (int by = 0; by < BLOCKS_PER_SIDE; ++by)
  {
    for (int bx = 0; bx < BLOCKS_PER_SIDE; ++bx)
    {
      double block = 0.0;
      int count = 0;
      for (int y = by * cells.height / BLOCKS_PER_SIDE; y < (by + 1) * cells.height / BLOCKS_PER_SIDE; ++y)
      {
        for (int x = bx * cells.width / BLOCKS_PER_SIDE; x < (bx + 1) * cells.width / BLOCKS_PER_SIDE; ++x)
        {
          const int index = y * cells.width + x;
          const auto i = static_cast<std::size_t>(index);
          block += second[i] - best[i];
          ++count;
        }
      }
      block /= std::max(count, 1);
      sum += block;
      squares += block * block;
    }
  }
  constexpr double BLOCKS = BLOCKS_PER_SIDE * BLOCKS_PER_SIDE;
  const double mean = sum / BLOCKS;
  const double variance = std::max(squares / BLOCKS - mean * mean, 0.0) * BLOCKS / (BLOCKS - 1.0);
  return mean / std::max(std::sqrt(variance / BLOCKS), 1e-9);
}

/// What the views of one distance and one set of displacements say.
struct Opinion
{
  FoundLayout found;
  int distance = 1;
  double difference = -1.0;  ///< second - best
};

Opinion opinionOf(const LineCosts& lines, int distance)
{
  const bool line_only = lines.horizontal_x.empty() || lines.vertical_x.empty();
  std::vector<std::pair<LayoutCost, GridLayout>> costs;
  for (const GridLayout& layout : LAYOUTS)
  {
    if (!(line_only && layout.mirrored))
    {
      costs.emplace_back(costOf(lines, layout), layout);
    }
  }
  std::stable_sort(costs.begin(), costs.end(),
                   [](const auto& a, const auto& b)
                   { return a.first.mean_of_least < b.first.mean_of_least; });
  const LayoutCost& best = costs[0].first;
  const LayoutCost& second = costs[1].first;
  Opinion opinion;
  opinion.distance = distance;
  opinion.found.layout = costs[0].second;
  opinion.difference = second.mean_of_least - best.mean_of_least;
  opinion.found.ratio = second.mean_of_least / std::max(best.mean_of_least, 1e-9);
  opinion.found.significance = significanceOf(best.least, second.least, lines.cells);
  opinion.found.match = best.mean_of_least / std::max(best.mean, 1e-9);
  return opinion;
}

/// The contrast images of a pair, moved to where no calibration's offset is left.
std::vector<SweptView> sweptViews(const LightField& light_field, const LineViews& pair, ThreadPool& pool)
{
  std::vector<SweptView> swept;
  const std::vector<ContrastView> views = contrastViews(light_field, pair.indices, pool);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    swept.push_back({shiftedBack(views[i]), pair.units[i]});
  }
  return swept;
}

LineCosts sweepLines(const cv::Mat& reference, const std::vector<SweptView>& horizontal,
                     const std::vector<SweptView>& vertical, const Displacements& displacements,
                     ThreadPool& pool)
{
  LineCosts lines;
  lines.cells = {reference.cols / CELL_SIDE_PX, reference.rows / CELL_SIDE_PX};
  if (!horizontal.empty())
  {
    lines.horizontal_x = sweepAxis(reference, horizontal, Axis::X, displacements, pool);
    lines.horizontal_y = sweepAxis(reference, horizontal, Axis::Y, displacements, pool);
  }
  if (!vertical.empty())
  {
    lines.vertical_x = sweepAxis(reference, vertical, Axis::X, displacements, pool);
    lines.vertical_y = sweepAxis(reference, vertical, Axis::Y, displacements, pool);
  }
  return lines;
}

/// Is it clear enough by itself?
bool isClear(const FoundLayout& found, double min_ratio, const LayoutOptions& options)
{
  return found.ratio >= min_ratio && found.significance >= options.min_significance &&
         found.match <= options.max_match;
}

/// The opinion with the largest difference counts. Where views at least as far away contradict, it has to be
/// the clearer: what is true shows the better, the farther the views stand apart. A clear contradiction, as
/// that of two views that have changed places, leaves the layout open.
FoundLayout decide(const std::vector<Opinion>& opinions, const LayoutOptions& options)
{
  const auto strongest =
      std::max_element(opinions.begin(), opinions.end(),
                       [](const Opinion& a, const Opinion& b) { return a.difference < b.difference; });
  FoundLayout found = strongest->found;
  double min_ratio = options.min_ratio;
  bool clearly_contradicted = false;
  for (const Opinion& other : opinions)
  {
    if (other.found.layout == found.layout)
    {
      continue;
    }
    clearly_contradicted = clearly_contradicted || isClear(other.found, options.min_ratio, options);
    if (other.distance >= strongest->distance && other.found.match <= options.max_match)
    {
      min_ratio = options.min_contradicted_ratio;
    }
  }
  found.decided = !clearly_contradicted && isClear(found, min_ratio, options);
  return found;
}

}  // namespace

std::vector<GridSymmetry> allGridSymmetries()
{
  std::vector<GridSymmetry> all;
  for (const bool transposed : {false, true})
  {
    for (const bool rows : {false, true})
    {
      for (const bool columns : {false, true})
      {
        all.push_back({rows, columns, transposed});
      }
    }
  }
  return all;
}

LightField relabelled(const LightField& light_field, const GridSymmetry& symmetry)
{
  const auto relabel = [&](auto& row, auto& column)
  {
    row = symmetry.rows_reversed ? -row : row;
    column = symmetry.columns_reversed ? -column : column;
    if (symmetry.transposed)
    {
      std::swap(row, column);
    }
  };
  std::vector<View> views = light_field.views;
  for (View& view : views)
  {
    relabel(view.grid.row, view.grid.column);
    relabel(view.steps.y, view.steps.x);
  }
  GridPosition reference = light_field.reference().grid;
  relabel(reference.row, reference.column);
  return makeLightField(std::move(views), reference, light_field.calibration);
}

FoundLayout findLayout(const LightField& light_field, ThreadPool& pool, const LayoutOptions& options)
{
  const cv::Mat reference = contrastViews(light_field, {light_field.reference_index}, pool).front().image;
  std::vector<Opinion> opinions;
  for (const int distance : layoutDistances(light_field))
  {
    const std::vector<SweptView> horizontal =
        sweptViews(light_field, viewsOnLine(light_field, true, distance), pool);
    const std::vector<SweptView> vertical =
        sweptViews(light_field, viewsOnLine(light_field, false, distance), pool);
    for (const Displacements& displacements : LABEL_SETS)
    {
      opinions.push_back(
          opinionOf(sweepLines(reference, horizontal, vertical, displacements, pool), distance));
    }
  }
  return opinions.empty() ? FoundLayout() : decide(opinions, options);
}

}  // namespace light_field_depth
