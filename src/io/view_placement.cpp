#include "io/view_placement.h"

#include <algorithm>
#include <cmath>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Positions whose mean step is smaller than this part of their spread do not follow the numbering.
constexpr double MIN_STEP_OVER_SPREAD = 1e-6;
/// Beyond this factor between them, the positions and the stated baseline are of different units.
constexpr double MAX_STEP_RATIO = 2.0;

bool flipsRows(Flip flip)
{
  return flip == Flip::Rows || flip == Flip::Both;
}

bool flipsColumns(Flip flip)
{
  return flip == Flip::Columns || flip == Flip::Both;
}

Flip makeFlip(bool rows, bool columns)
{
  if (rows && columns)
  {
    return Flip::Both;
  }
  return rows ? Flip::Rows : columns ? Flip::Columns : Flip::None;
}

void checkNumbers(const std::vector<ViewFile>& views)
{
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const GridPosition& number = views[i].number;
    if (!canBeCounted(number))
    {
      throw InputError("The view '" + views[i].path.string() + "' has the place " + toString(number) +
                       "; rows and columns are counted up to " + std::to_string(MAX_NUMBER) + ".");
    }
    if (i > 0 && number == views[i - 1].number)
    {
      throw InputError("The place " + toString(number) + " is taken by two files, '" +
                       views[i - 1].path.string() + "' and '" + views[i].path.string() +
                       "'; keep one of them.");
    }
  }
}

/// The smallest rectangle of numbers that holds all views.
cv::Rect spannedGrid(const std::vector<ViewFile>& views)
{
  cv::Rect span(views.front().number.column, views.front().number.row, 1, 1);
  for (const ViewFile& view : views)
  {
    span |= cv::Rect(view.number.column, view.number.row, 1, 1);
  }
  return span;
}

/// The view nearest to a place on the grid; the first in row-major order of several.
GridPosition nearestView(const std::vector<ViewFile>& views, const GridPosition& place)
{
  const auto distance = [&](const ViewFile& view)
  { return std::hypot(view.number.row - place.row, view.number.column - place.column); };
  return std::min_element(views.begin(), views.end(),
                          [&](const ViewFile& a, const ViewFile& b) { return distance(a) < distance(b); })
      ->number;
}

GridPosition chooseReference(const std::filesystem::path& folder, const std::vector<ViewFile>& views,
                             const std::optional<GridPosition>& wanted, const GridPosition& nominal)
{
  if (!wanted)
  {
    return nearestView(views, nominal);
  }
  const bool there =
      std::any_of(views.begin(), views.end(), [&](const ViewFile& view) { return view.number == *wanted; });
  if (!there)
  {
    const cv::Rect span = spannedGrid(views);
    throw InputError("The reference view " + toString(*wanted) + " is not in '" + folder.string() +
                     "'; the views there go from " + toString(GridPosition{span.y, span.x}) + " to " +
                     toString(GridPosition{span.br().y - 1, span.br().x - 1}) + ".");
  }
  return *wanted;
}

/// The mean change of `value` from one number to the next (least squares); 0 if there is but one number.
template <class Number, class Value>
double meanStep(const std::vector<ViewFile>& views, Number number, Value value)
{
  double number_mean = 0.0;
  double value_mean = 0.0;
  for (const ViewFile& view : views)
  {
    number_mean += number(view) / static_cast<double>(views.size());
    value_mean += value(view) / static_cast<double>(views.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const ViewFile& view : views)
  {
    covariance += (number(view) - number_mean) * (value(view) - value_mean);
    variance += (number(view) - number_mean) * (number(view) - number_mean);
  }
  return variance > 0.0 ? covariance / variance : 0.0;
}

/// How the positions of a dataset follow its numbers.
struct PositionGrid
{
  double column_step = 0.0;  ///< along x; 0 if there is but one column
  double row_step = 0.0;     ///< along y; 0 if there is but one row
};

std::optional<PositionGrid> fitPositions(const std::filesystem::path& folder,
                                         const std::vector<ViewFile>& views)
{
  const auto missing =
      std::find_if(views.begin(), views.end(), [](const ViewFile& view) { return !view.position; });
  if (missing != views.end())
  {
    if (std::any_of(views.begin(), views.end(),
                    [](const ViewFile& view) { return view.position.has_value(); }))
    {
      throw InputError("The view '" + missing->path.string() +
                       "' has no position, but others have one; give all views a position, or none.");
    }
    return std::nullopt;
  }
  PositionGrid grid;
  grid.column_step = meanStep(
      views, [](const ViewFile& view) { return view.number.column; },
      [](const ViewFile& view) { return view.position->x; });
  grid.row_step = meanStep(
      views, [](const ViewFile& view) { return view.number.row; },
      [](const ViewFile& view) { return view.position->y; });
  const cv::Rect span = spannedGrid(views);
  const double spread = std::max(std::abs(grid.column_step), std::abs(grid.row_step));
  const double least = spread * MIN_STEP_OVER_SPREAD;
  if (!(spread > 0.0) || (span.width > 1 && std::abs(grid.column_step) <= least) ||
      (span.height > 1 && std::abs(grid.row_step) <= least))
  {
    throw InputError("The camera positions in '" + folder.string() +
                     "' do not follow the numbers of rows and columns; check that x changes with the column "
                     "and y with the row.");
  }
  return grid;
}

void checkStepLength(const std::filesystem::path& folder, const PositionGrid& positions, double step_length)
{
  const double ratio = std::abs(positions.column_step) / step_length;
  if (positions.column_step != 0.0 && (ratio > MAX_STEP_RATIO || ratio < 1.0 / MAX_STEP_RATIO))
  {
    throw InputError("In '" + folder.string() + "' the camera positions are " +
                     std::to_string(std::abs(positions.column_step)) +
                     " m apart from column to column, but baseline_m says " + std::to_string(step_length) +
                     "; make them agree.");
  }
}

/// The length of one step in the unit of the positions.
double stepLength(const FolderDescription& description, const PositionGrid& positions)
{
  const double column_step = std::abs(positions.column_step);
  return description.step_length.value_or(column_step > 0.0 ? column_step : std::abs(positions.row_step));
}

/// Where a view stands in units of one column step, before the reference is subtracted.
class StepRule
{
public:
  StepRule(const FolderDescription& description, const std::optional<PositionGrid>& positions, Flip flip)
      : number_scale_(flipsColumns(flip) ? -1.0 : 1.0,
                      (flipsRows(flip) ? -1.0 : 1.0) * description.row_step_ratio)
  {
    if (positions)
    {
      const double unit = stepLength(description, *positions);
      position_scale_ = {std::copysign(1.0 / unit, positions->column_step * number_scale_.x),
                         std::copysign(1.0 / unit, positions->row_step * number_scale_.y)};
    }
  }

  cv::Point2d operator()(const ViewFile& view) const
  {
    return view.position
               ? cv::Point2d(view.position->x * position_scale_.x, view.position->y * position_scale_.y)
               : ofNumber(view.number);
  }

  cv::Point2d ofNumber(const GridPosition& number) const
  {
    return {number.column * number_scale_.x, number.row * number_scale_.y};
  }

private:
  cv::Point2d number_scale_;
  cv::Point2d position_scale_;
};

cv::Point2d stepsBetween(const std::vector<ViewFile>& views, const StepRule& steps, const GridPosition& from,
                         const GridPosition& to)
{
  const auto find = [&](const GridPosition& number)
  {
    return std::find_if(views.begin(), views.end(),
                        [&](const ViewFile& view) { return view.number == number; });
  };
  const auto first = find(from);
  const auto last = find(to);
  return first != views.end() && last != views.end() ? steps(*last) - steps(*first)
                                                     : steps.ofNumber(to) - steps.ofNumber(from);
}

/// Rows become columns, in numbers and positions. The step length stays that of the first direction.
void transpose(FolderDescription& description)
{
  for (ViewFile& view : description.views)
  {
    std::swap(view.number.row, view.number.column);
    if (view.position)
    {
      std::swap(view.position->x, view.position->y);
    }
  }
  if (description.grid)
  {
    std::swap(description.grid->x, description.grid->y);
    std::swap(description.grid->width, description.grid->height);
  }
  if (description.reference)
  {
    std::swap(description.reference->row, description.reference->column);
  }
}

}  // namespace

PlacedViews placeViews(const std::filesystem::path& folder, FolderDescription& description,
                       const Layout& layout, const std::optional<GridPosition>& wanted_reference)
{
  const bool own_order = layout.order == description.order.value_or(Order::RowMajor);
  if (layout.order == Order::ColumnMajor)
  {
    transpose(description);
  }
  std::vector<ViewFile>& files = description.views;
  std::sort(files.begin(), files.end(),
            [](const ViewFile& a, const ViewFile& b) { return a.number < b.number; });
  checkNumbers(files);
  const cv::Rect grid = description.grid.value_or(spannedGrid(files)) | spannedGrid(files);
  const auto positions = fitPositions(folder, files);
  if (positions && description.step_length)
  {
    checkStepLength(folder, *positions, *description.step_length);
  }
  const Flip own_flip = description.flip.value_or(
      positions ? makeFlip(positions->row_step < 0.0, positions->column_step < 0.0) : Flip::None);

  PlacedViews placed;
  placed.flip = layout.flip.value_or(own_flip);
  placed.own_layout = placed.flip == own_flip && own_order;
  const auto place = [&](const GridPosition& number)
  {
    return GridPosition{flipsRows(placed.flip) ? grid.y + grid.br().y - 1 - number.row : number.row,
                        flipsColumns(placed.flip) ? grid.x + grid.br().x - 1 - number.column : number.column};
  };
  const StepRule steps(description, positions, placed.flip);
  const GridPosition nominal = description.reference.value_or(
      GridPosition{grid.y + (grid.height - 1) / 2, grid.x + (grid.width - 1) / 2});
  const GridPosition reference = chooseReference(folder, files, wanted_reference, nominal);
  placed.reference = place(reference);
  if (positions && description.position_unit_m)
  {
    placed.step_m = stepLength(description, *positions) * *description.position_unit_m;
  }
  placed.own_reference = reference == nominal;
  placed.reference_steps = stepsBetween(files, steps, nominal, reference);

  std::sort(files.begin(), files.end(),
            [&](const ViewFile& a, const ViewFile& b) { return place(a.number) < place(b.number); });
  for (const ViewFile& file : files)
  {
    View view;
    view.grid = place(file.number);
    view.steps = steps(file);
    placed.views.push_back(view);
  }
  return placed;
}

}  // namespace light_field_depth
