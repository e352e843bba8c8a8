#include "light_field_depth/ros/view_array.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <ros/names.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
using XmlRpc::XmlRpcValue;

constexpr const char* DEFAULT_IMAGE_TOPIC = "view_{row}_{column}/image_rect_color";
constexpr const char* DEFAULT_CAMERA_INFO_TOPIC = "view_{row}_{column}/camera_info";
constexpr int DEFAULT_SIDE = 9;  // the views of the HCI benchmark and of most plenoptic captures
/// More is a slip of the pen rather than an array.
constexpr int MAX_SIDE = 1000;

/// Reads the members of one struct and refuses those that it does not know.
class StructReader
{
public:
  StructReader(const XmlRpcValue& value, std::string path) : value_(value), path_(std::move(path))
  {
    if (value_.getType() != XmlRpcValue::TypeStruct)
    {
      throw InputError("The parameter '" + path_ +
                       "' is not a set of fields; write 'field: value' lines, as in "
                       "config/arrays/cross_9x9.yaml.");
    }
  }

  bool has(const std::string& field)
  {
    known_.insert(field);
    return value_.hasMember(field);
  }

  int integer(const std::string& field, int smallest, int largest)
  {
    XmlRpcValue value = member(field, XmlRpcValue::TypeInt, "a whole number");
    const int number = static_cast<int>(value);
    if (number < smallest || number > largest)
    {
      throw InputError("The parameter '" + path_ + "/" + field + "' is " + std::to_string(number) +
                       "; give a number from " + std::to_string(smallest) + " to " + std::to_string(largest) +
                       ".");
    }
    return number;
  }

  std::string text(const std::string& field)
  {
    XmlRpcValue member_value = member(field, XmlRpcValue::TypeString, "a text");
    std::string value = static_cast<std::string&>(member_value);
    if (value.empty())
    {
      throw InputError("The parameter '" + path_ + "/" + field + "' is empty; give it a value.");
    }
    return value;
  }

  std::string text(const std::string& field, const std::string& when_absent)
  {
    return has(field) ? text(field) : when_absent;
  }

  const XmlRpcValue& array(const std::string& field)
  {
    return member(field, XmlRpcValue::TypeArray, "a list");
  }

  /// @throw InputError for a field that nothing has asked for
  void refuseUnknown() const
  {
    for (const auto& entry : value_)
    {
      if (known_.count(entry.first) == 0)
      {
        std::string names;
        for (const std::string& name : known_)
        {
          names += (names.empty() ? "" : ", ") + name;
        }
        throw InputError("The parameter '" + path_ + "' has a field '" + entry.first +
                         "' that is not known; the fields are: " + names + ".");
      }
    }
  }

private:
  const XmlRpcValue& member(const std::string& field, XmlRpcValue::Type type, const char* type_name)
  {
    if (!has(field))
    {
      throw InputError("The parameter '" + path_ + "/" + field + "' is missing; add it.");
    }
    const XmlRpcValue& value = value_[field];
    if (value.getType() != type)
    {
      throw InputError("The parameter '" + path_ + "/" + field + "' is not " + type_name + "; correct it.");
    }
    return value;
  }

  XmlRpcValue value_;
  std::string path_;
  std::set<std::string> known_;
};

GridPosition referenceFrom(XmlRpcValue value)
{
  if (value.size() != 2 || value[0].getType() != XmlRpcValue::TypeInt ||
      value[1].getType() != XmlRpcValue::TypeInt)
  {
    throw InputError("The parameter 'array/reference' is not a row and a column; write 'reference: [4, 4]'.");
  }
  return {static_cast<int>(value[0]), static_cast<int>(value[1])};
}

ViewSelection layoutFrom(const std::string& name)
{
  if (name == "auto")
  {
    throw InputError("The parameter 'array/layout' is 'auto'; choose all, cross, row, column or star.");
  }
  try
  {
    return viewSelectionFromString(name);
  }
  catch (const InputError&)
  {
    throw InputError("The parameter 'array/layout' is '" + name +
                     "'; choose all, cross, row, column or star.");
  }
}

/// A light field needs images; these only carry the positions through makeLightField() and selectViews(), so
/// that topics and datasets agree on what a cross is and which view is the middle one.
LightField placeholders(const std::vector<GridPosition>& grid, const std::optional<GridPosition>& reference)
{
  const cv::Mat image = cv::Mat::zeros(16, 16, CV_8UC1);
  std::vector<View> views;
  views.reserve(grid.size());
  for (const GridPosition& position : grid)
  {
    views.push_back(gridView(position.row, position.column, image));
  }
  return makeLightField(std::move(views), reference);
}

/// What {row} and {column} make the names of each view.
struct Patterns
{
  std::string image = DEFAULT_IMAGE_TOPIC;
  std::string camera_info = DEFAULT_CAMERA_INFO_TOPIC;
  std::string mask;
  std::string mask_file;
  std::string camera_info_url;
};

ViewArray patternArray(int rows, int columns, ViewSelection layout, const Patterns& patterns,
                       const std::optional<GridPosition>& reference)
{
  std::vector<GridPosition> grid;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      grid.push_back({row, column});
    }
  }
  const LightField selected = selectViews(placeholders(grid, reference), layout);
  ViewArray array;
  array.reference = selected.reference_index;
  for (const View& view : selected.views)
  {
    array.views.push_back({view.grid, topicFromPattern(patterns.image, view.grid),
                           topicFromPattern(patterns.camera_info, view.grid),
                           topicFromPattern(patterns.mask, view.grid),
                           topicFromPattern(patterns.mask_file, view.grid),
                           topicFromPattern(patterns.camera_info_url, view.grid)});
  }
  return array;
}

ViewArray patternArrayFrom(StructReader& fields, const std::optional<GridPosition>& reference)
{
  const int rows = fields.integer("rows", 1, MAX_SIDE);
  const int columns = fields.integer("columns", 1, MAX_SIDE);
  const ViewSelection layout = layoutFrom(fields.text("layout", "all"));
  const Patterns patterns{fields.text("image_topic", DEFAULT_IMAGE_TOPIC),
                          fields.text("camera_info_topic", DEFAULT_CAMERA_INFO_TOPIC),
                          fields.text("mask_topic", ""), fields.text("mask_file", ""),
                          fields.text("camera_info_url", "")};
  return patternArray(rows, columns, layout, patterns, reference);
}

ViewArray listedArrayFrom(const XmlRpcValue& list, const std::optional<GridPosition>& reference)
{
  std::vector<GridPosition> grid;
  ViewArray array;
  for (int i = 0; i < list.size(); ++i)
  {
    StructReader fields(list[i], "array/views[" + std::to_string(i) + "]");
    ViewTopics view;
    view.grid.row = fields.integer("row", -MAX_SIDE, MAX_SIDE);
    view.grid.column = fields.integer("column", -MAX_SIDE, MAX_SIDE);
    view.image = fields.text("image");
    view.camera_info_url = fields.text("camera_info_url", "");
    view.camera_info = view.camera_info_url.empty() ? fields.text("camera_info")
                                                    : fields.text("camera_info", view.image + "/camera_info");
    view.mask = fields.text("mask", "");
    view.mask_file = fields.text("mask_file", "");
    fields.refuseUnknown();
    grid.push_back(view.grid);
    array.views.push_back(std::move(view));
  }
  std::sort(array.views.begin(), array.views.end(),
            [](const ViewTopics& a, const ViewTopics& b) { return a.grid < b.grid; });
  array.reference = placeholders(grid, reference).reference_index;
  return array;
}

/// What roscpp would refuse when the topics are subscribed to, which may be much later.
void refuseBadTopics(const ViewArray& array)
{
  for (const ViewTopics& view : array.views)
  {
    for (const std::string& topic : {view.image, view.camera_info, view.mask})
    {
      std::string problem;
      const bool none = topic.empty() && view.mask.empty();  // of the image and the CameraInfo there is one
      if (!none && (!ros::names::validate(topic, problem) || topic.front() == '~'))
      {
        throw InputError(
            "View " + toString(view.grid) + " has the topic '" + topic +
            "', which is not a name that can be subscribed to; begin with a letter or '/', and go on "
            "with letters, digits, '_' and '/'.");
      }
    }
  }
}

/// One topic for two views would give both the same image.
void refuseSharedTopics(const ViewArray& array)
{
  std::set<std::string> topics;
  for (const ViewTopics& view : array.views)
  {
    if (!topics.insert(view.image).second)
    {
      throw InputError("View " + toString(view.grid) + " has the image topic '" + view.image +
                       "' of another view; give every view its own topic, or put {row} and {column} into the "
                       "pattern.");
    }
  }
}

}  // namespace

std::vector<GridPosition> gridOf(const ViewArray& array)
{
  std::vector<GridPosition> grid;
  for (const ViewTopics& view : array.views)
  {
    grid.push_back(view.grid);
  }
  return grid;
}

std::string describe(const ViewTopics& view)
{
  return "View " + toString(view.grid) + " (" + view.image + ")";
}

std::string topicFromPattern(const std::string& pattern, const GridPosition& position)
{
  std::string topic = pattern;
  const auto replace = [&topic](const std::string& placeholder, int value)
  {
    for (std::size_t at = topic.find(placeholder); at != std::string::npos; at = topic.find(placeholder))
    {
      topic.replace(at, placeholder.size(), std::to_string(value));
    }
  };
  replace("{row}", position.row);
  replace("{column}", position.column);
  return topic;
}

ViewArray viewArrayFromParameter(const XmlRpc::XmlRpcValue& parameter)
{
  StructReader fields(parameter, "array");
  std::optional<GridPosition> reference;
  if (fields.has("reference"))
  {
    reference = referenceFrom(fields.array("reference"));
  }
  ViewArray array = fields.has("views") ? listedArrayFrom(fields.array("views"), reference)
                                        : patternArrayFrom(fields, reference);
  fields.refuseUnknown();
  refuseBadTopics(array);
  refuseSharedTopics(array);
  return array;
}

ViewArray defaultViewArray()
{
  return patternArray(DEFAULT_SIDE, DEFAULT_SIDE, ViewSelection::Cross, Patterns(), std::nullopt);
}

}  // namespace light_field_depth
