#include "io/dataset_layout.h"

#include <algorithm>
#include <cmath>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
std::string gridText(const cv::Size& grid)
{
  return std::to_string(grid.height) + " x " + std::to_string(grid.width);
}

/// A square number is a square; all else is a row until something better is known.
cv::Size guessedGrid(int count)
{
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  return side * side == count ? cv::Size(side, side) : cv::Size(count, 1);
}

}  // namespace

void settleGrid(FolderDescription& description, const DatasetOptions& options, ViewStore& /*store*/)
{
  if (description.place_claim != PlaceClaim::SingleNumber)
  {
    return;
  }
  std::vector<ViewFile>& views = description.views;
  const auto by_column = [](const ViewFile& a, const ViewFile& b)
  { return a.number.column < b.number.column; };
  const int first = std::min_element(views.begin(), views.end(), by_column)->number.column;
  const int count = std::max_element(views.begin(), views.end(), by_column)->number.column - first + 1;
  cv::Size grid = guessedGrid(count);
  if (options.grid)
  {
    grid = *options.grid;
  }
  else if (description.grid)
  {
    grid = description.grid->size();
  }
  if (count > grid.area())
  {
    throw InputError("The numbers of the views span " + std::to_string(count) + " places, but a grid of " +
                     gridText(grid) + " has " + std::to_string(grid.area()) +
                     "; --grid ROWSxCOLUMNS says which one it is.");
  }
  for (ViewFile& view : views)
  {
    const int index = view.number.column - first;
    view.number = {index / grid.width, index % grid.width};
  }
  description.grid = cv::Rect({0, 0}, grid);
}

Layout settleLayout(FolderDescription& description, const DatasetOptions& options, ViewStore& /*store*/)
{
  Layout layout;
  layout.order = options.order.value_or(description.order.value_or(Order::RowMajor));
  layout.flip = options.flip;
  return layout;
}

}  // namespace light_field_depth
