#include "core/paper2017/angular_volume.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <sstream>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
using OnLine = std::function<bool(const GridPosition&)>;

/// The views on one line of the grid. They are row-major in the light field, so every line but a column
/// is already in order, and a column is as well.
AngularVolume volumeOn(const LightField& light_field, const std::string& name, const OnLine& on_line)
{
  AngularVolume volume{name, {}};
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (on_line(light_field.views[i].grid))
    {
      volume.view_indices.push_back(i);
    }
  }
  return volume;
}

AngularVolume rowVolume(const LightField& light_field, int row)
{
  return volumeOn(light_field, "row_" + std::to_string(row),
                  [row](const GridPosition& grid) { return grid.row == row; });
}

AngularVolume columnVolume(const LightField& light_field, int column)
{
  return volumeOn(light_field, "column_" + std::to_string(column),
                  [column](const GridPosition& grid) { return grid.column == column; });
}

/// The numbers in a text, or nothing when there is something else in it.
std::optional<std::vector<int>> lineNumbers(std::string text)
{
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::vector<int> numbers;
  for (int number = 0; stream >> number;)
  {
    numbers.push_back(number);
  }
  if (!stream.eof())
  {
    return std::nullopt;
  }
  return numbers;
}

std::vector<AngularVolume> namedVolumes(const LightField& light_field, const AngularVolumeOptions& options)
{
  std::vector<AngularVolume> volumes;
  for (const int row : lineNumbers(options.rows).value_or(std::vector<int>()))
  {
    volumes.push_back(rowVolume(light_field, row));
  }
  for (const int column : lineNumbers(options.columns).value_or(std::vector<int>()))
  {
    volumes.push_back(columnVolume(light_field, column));
  }
  for (const AngularVolume& volume : volumes)
  {
    if (volume.view_indices.size() < 2)
    {
      throw InputError("The angular volume " + volume.name + " has " +
                       std::to_string(volume.view_indices.size()) +
                       " view(s); name a row or column in which at least two views stand.");
    }
  }
  return volumes;
}

std::vector<AngularVolume> selectedVolumes(const LightField& light_field, ViewSelection selection)
{
  const GridPosition centre = light_field.reference().grid;
  std::vector<AngularVolume> volumes;
  if (selection == ViewSelection::All)
  {
    std::set<int> rows;
    std::set<int> columns;
    for (const View& view : light_field.views)
    {
      rows.insert(view.grid.row);
      columns.insert(view.grid.column);
    }
    for (const int row : rows)
    {
      volumes.push_back(rowVolume(light_field, row));
    }
    for (const int column : columns)
    {
      volumes.push_back(columnVolume(light_field, column));
    }
    return volumes;
  }
  if (selection != ViewSelection::Column)
  {
    volumes.push_back(rowVolume(light_field, centre.row));
  }
  if (selection != ViewSelection::Row)
  {
    volumes.push_back(columnVolume(light_field, centre.column));
  }
  if (selection == ViewSelection::Star)
  {
    volumes.push_back(volumeOn(light_field, "diagonal_down",
                               [&](const GridPosition& g)
                               { return g.row - centre.row == g.column - centre.column; }));
    volumes.push_back(volumeOn(light_field, "diagonal_up",
                               [&](const GridPosition& g)
                               { return g.row - centre.row == centre.column - g.column; }));
  }
  return volumes;
}

std::vector<AngularVolume> pairsWithReference(const LightField& light_field)
{
  std::vector<AngularVolume> volumes;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i != light_field.reference_index)
    {
      const GridPosition& grid = light_field.views[i].grid;
      volumes.push_back({"pair_" + std::to_string(grid.row) + "_" + std::to_string(grid.column),
                         {light_field.reference_index, i}});
    }
  }
  return volumes;
}

/// Views that stand at one place, which calibrated arrays may have, show no disparity between them.
void dropCoincidentViews(const LightField& light_field, AngularVolume& volume)
{
  /// Above rounding errors of steps, far below one step.
  constexpr double SAME_PLACE_STEPS = 1e-6;
  auto& indices = volume.view_indices;
  const auto coincident = [&](std::size_t a, std::size_t b)
  { return cv::norm(light_field.views[a].steps - light_field.views[b].steps) < SAME_PLACE_STEPS; };
  indices.erase(std::unique(indices.begin(), indices.end(), coincident), indices.end());
}

void dropShortVolumes(const LightField& light_field, std::vector<AngularVolume>& volumes)
{
  for (AngularVolume& volume : volumes)
  {
    dropCoincidentViews(light_field, volume);
  }
  volumes.erase(std::remove_if(volumes.begin(), volumes.end(),
                               [](const AngularVolume& volume) { return volume.view_indices.size() < 2; }),
                volumes.end());
}

}  // namespace

std::vector<AngularVolume> extractVolumes(const LightField& light_field, ViewSelection selection,
                                          const AngularVolumeOptions& options)
{
  const bool named = !options.rows.empty() || !options.columns.empty();
  std::vector<AngularVolume> volumes =
      named ? namedVolumes(light_field, options) : selectedVolumes(light_field, selection);
  dropShortVolumes(light_field, volumes);
  if (volumes.empty())
  {
    volumes = pairsWithReference(light_field);
    dropShortVolumes(light_field, volumes);
  }
  return volumes;
}

std::vector<std::string> validate(const AngularVolumeOptions& options)
{
  std::vector<std::string> problems;
  const auto check = [&](const std::string& name, const std::string& text)
  {
    if (!lineNumbers(text))
    {
      problems.push_back(name + " is '" + text + "'; give whole numbers separated by commas, or nothing.");
    }
  };
  check("volume_rows", options.rows);
  check("volume_columns", options.columns);
  return problems;
}

ViewPair pairOf(const View& from, const View& to)
{
  return {to.steps - from.steps, to.offset_px - from.offset_px};
}

}  // namespace light_field_depth
