#include "light_field_depth/core/light_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/enum_names.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Set by hand; tests solve views of this size.
constexpr int MIN_VIEW_SIDE_PX = 16;

/// Steps, and pixels of offset: no array is so large, and products with disparities stay exact enough.
constexpr double FARTHEST = 1e6;

constexpr EnumNames<ViewSelection, 6> SELECTION_NAMES = {{
    {ViewSelection::Auto, "auto"},
    {ViewSelection::Row, "row"},
    {ViewSelection::Column, "column"},
    {ViewSelection::Cross, "cross"},
    {ViewSelection::Star, "star"},
    {ViewSelection::All, "all"},
}};

std::string sizeText(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

std::string typeText(int type)
{
  static const std::array<const char*, 8> depths = {"8-bit",  "signed 8-bit", "16-bit", "signed 16-bit",
                                                    "32-bit", "float",        "double", "half"};
  return std::string(depths[static_cast<std::size_t>(CV_MAT_DEPTH(type))]) + " with " +
         std::to_string(CV_MAT_CN(type)) + " channel(s)";
}

void checkImage(const View& view, const View& first)
{
  const std::string name = "View " + toString(view.grid);
  if (view.image.empty())
  {
    throw InputError(name + " has an empty image; leave the view out or give it an image.");
  }
  const int type = view.image.type();
  if (type != CV_8UC1 && type != CV_8UC3 && type != CV_16UC1 && type != CV_16UC3)
  {
    throw InputError(name + " has an image of type " + typeText(type) +
                     "; convert it to 8 or 16 bits with 1 (grey) or 3 (BGR) channels.");
  }
  if (view.image.size() != first.image.size())
  {
    throw InputError(name + " has an image of " + sizeText(view.image.size()) + " pixels, but view " +
                     toString(first.grid) + " has " + sizeText(first.image.size()) +
                     "; all views must be rectified to one size.");
  }
  if (type != first.image.type())
  {
    throw InputError(name + " has an image of type " + typeText(type) + ", but view " + toString(first.grid) +
                     " has " + typeText(first.image.type()) + "; convert all views to one type.");
  }
  if (!view.mask.empty() && (view.mask.type() != CV_8UC1 || view.mask.size() != view.image.size()))
  {
    throw InputError(name + " has a mask of " + sizeText(view.mask.size()) + " pixels, " +
                     typeText(view.mask.type()) + ", for an image of " + sizeText(view.image.size()) +
                     "; give it 8 bits, one channel and the size of the image, or leave it out.");
  }
  if (view.image.cols < MIN_VIEW_SIDE_PX || view.image.rows < MIN_VIEW_SIDE_PX)
  {
    throw InputError(name + " has an image of " + sizeText(view.image.size()) + " pixels; at least " +
                     std::to_string(MIN_VIEW_SIDE_PX) + " x " + std::to_string(MIN_VIEW_SIDE_PX) +
                     " are needed.");
  }
  for (const double value : {view.steps.x, view.steps.y, view.offset_px.x, view.offset_px.y})
  {
    if (!std::isfinite(value))
    {
      throw InputError(name + " has a position that is not finite; check its calibration.");
    }
    if (std::abs(value) > FARTHEST)
    {
      throw InputError(
          name + " is " + std::to_string(value) +
          " steps (or pixels of offset) away; at most a million can be used. Check its position.");
    }
  }
}

void checkCalibration(const Calibration& calibration)
{
  const auto require_positive = [](double value, const char* field)
  {
    if (!std::isfinite(value) || value <= 0.0)
    {
      throw InputError(std::string("The calibration's ") + field + " is " + std::to_string(value) +
                       "; it must be a positive number.");
    }
  };
  require_positive(calibration.focal_length_px, "focal_length_px");
  require_positive(calibration.baseline_m, "baseline_m");
  const auto require_finite = [](double value, const char* field)
  {
    if (!std::isfinite(value))
    {
      throw InputError(std::string("The calibration's ") + field + " is not a finite number.");
    }
  };
  require_finite(calibration.principal_point_px.x, "principal_point_px.x");
  require_finite(calibration.principal_point_px.y, "principal_point_px.y");
  require_finite(calibration.disparity_offset_px, "disparity_offset_px");
}

/// The view nearest the middle of the grid positions that the views span; the first in row-major order of
/// several.
std::size_t middleView(const std::vector<View>& views)
{
  int row_min = std::numeric_limits<int>::max();
  int row_max = std::numeric_limits<int>::min();
  int column_min = row_min;
  int column_max = row_max;
  for (const View& view : views)
  {
    row_min = std::min(row_min, view.grid.row);
    row_max = std::max(row_max, view.grid.row);
    column_min = std::min(column_min, view.grid.column);
    column_max = std::max(column_max, view.grid.column);
  }
  const double middle_row = 0.5 * (row_min + row_max);
  const double middle_column = 0.5 * (column_min + column_max);
  const auto distance = [&](const View& view)
  { return std::hypot(view.grid.row - middle_row, view.grid.column - middle_column); };
  const auto nearest = std::min_element(
      views.begin(), views.end(), [&](const View& a, const View& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - views.begin());
}

/// Whether a view stands elsewhere than the reference, at which the steps begin.
bool standsApart(const View& view)
{
  constexpr double SAME_PLACE_STEPS = 1e-9;  // what rounding makes of equal positions
  return std::max(std::abs(view.steps.x), std::abs(view.steps.y)) >= SAME_PLACE_STEPS;
}

std::size_t indexOf(const std::vector<View>& views, const GridPosition& position)
{
  const auto found =
      std::find_if(views.begin(), views.end(), [&](const View& view) { return view.grid == position; });
  if (found == views.end())
  {
    throw InputError("The reference view " + toString(position) + " is not among the " +
                     std::to_string(views.size()) + " views; name one that is there.");
  }
  return static_cast<std::size_t>(found - views.begin());
}

bool isSelected(const GridPosition& offset, ViewSelection selection)
{
  const bool in_row = offset.row == 0;
  const bool in_column = offset.column == 0;
  const bool on_diagonal = std::abs(offset.row) == std::abs(offset.column);
  switch (selection)
  {
    case ViewSelection::Row:
      return in_row;
    case ViewSelection::Column:
      return in_column;
    case ViewSelection::Cross:
      return in_row || in_column;
    case ViewSelection::Star:
      return in_row || in_column || on_diagonal;
    case ViewSelection::Auto:
    case ViewSelection::All:
      break;
  }
  return true;
}

}  // namespace

std::string toString(const GridPosition& position)
{
  return "(" + std::to_string(position.row) + ", " + std::to_string(position.column) + ")";
}

View gridView(int row, int column, cv::Mat image)
{
  View view;
  view.grid = {row, column};
  view.image = std::move(image);
  view.steps = cv::Point2d(column, row);
  return view;
}

LightField makeLightField(std::vector<View> views, std::optional<GridPosition> reference,
                          std::optional<Calibration> calibration)
{
  if (views.size() < 2)
  {
    throw InputError("The light field has " + std::to_string(views.size()) +
                     " view(s); disparity needs at least two views of one scene.");
  }
  std::sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.grid < b.grid; });
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    checkImage(views[i], views.front());
    if (i > 0 && views[i].grid == views[i - 1].grid)
    {
      throw InputError("View " + toString(views[i].grid) +
                       " occurs twice; give every view its own grid position.");
    }
  }
  if (calibration)
  {
    checkCalibration(*calibration);
  }

  LightField light_field;
  light_field.reference_index = reference ? indexOf(views, *reference) : middleView(views);
  const cv::Point2d reference_steps = views[light_field.reference_index].steps;
  const cv::Point2d reference_offset = views[light_field.reference_index].offset_px;
  for (View& view : views)
  {
    view.steps -= reference_steps;
    view.offset_px -= reference_offset;
  }
  if (std::none_of(views.begin(), views.end(), standsApart))
  {
    throw InputError(
        "All views stand at the position of the reference view; disparity needs a baseline between "
        "them. Check the positions or the CameraInfo of the views.");
  }
  light_field.views = std::move(views);
  const cv::Mat& mask = light_field.reference().mask;
  if (!mask.empty() && cv::countNonZero(mask) == 0)
  {
    throw InputError("The mask of the reference view " + toString(light_field.reference().grid) +
                     " is 0 everywhere, so nothing is left to see; correct it or leave it out.");
  }
  light_field.calibration = calibration;
  return light_field;
}

std::string toString(ViewSelection selection)
{
  return enumName(SELECTION_NAMES, selection);
}

ViewSelection viewSelectionFromString(const std::string& name)
{
  return enumValue(SELECTION_NAMES, name, "view selection");
}

LightField selectViews(const LightField& light_field, ViewSelection selection)
{
  LightField selected;
  selected.calibration = light_field.calibration;
  const GridPosition centre = light_field.reference().grid;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const View& view = light_field.views[i];
    if (!isSelected({view.grid.row - centre.row, view.grid.column - centre.column}, selection))
    {
      continue;
    }
    if (i == light_field.reference_index)
    {
      selected.reference_index = selected.views.size();
    }
    selected.views.push_back(view);
  }
  if (selected.views.size() < 2)
  {
    throw InputError("The view selection '" + toString(selection) + "' leaves only the reference view " +
                     toString(centre) + "; choose another selection or another reference view.");
  }
  if (std::none_of(selected.views.begin(), selected.views.end(), standsApart))
  {
    throw InputError("The view selection '" + toString(selection) +
                     "' leaves only views at the place of the reference view " + toString(centre) +
                     "; choose another selection, or check the positions of the views.");
  }
  return selected;
}

cv::Mat toGrey(const cv::Mat& image)
{
  if (image.channels() == 1)
  {
    return image;
  }
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace light_field_depth
