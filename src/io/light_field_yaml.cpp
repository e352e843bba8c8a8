// light_field.yaml: a folder described by its owner.

#include <algorithm>
#include <regex>
#include <set>

#include "io/dataset_format.h"
#include "io/folder_description.h"
#include "io/yaml_fields.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Far more than any camera or numbering has; larger ones are slips of the pen.
constexpr int MAX_GRID_SIDE = 255;
constexpr int MAX_FIRST = 9999;
constexpr const char* DESCRIPTION_FILE = "light_field.yaml";

std::string padded(int number, std::size_t width)
{
  std::string digits = std::to_string(number);
  return digits.size() < width ? std::string(width - digits.size(), '0') + digits : digits;
}

/// A file name with the fields {row}, {column} and {index}; {row:02} has at least two digits.
class NamePattern
{
public:
  NamePattern(const YamlFields& fields, std::string text) : text_(std::move(text))
  {
    static const std::regex field(R"(\{(row|column|index)(?::0?([1-9]))?\})");
    std::string rest;
    auto begin = text_.cbegin();
    std::set<std::string> names;
    for (std::sregex_iterator match(text_.begin(), text_.end(), field), end; match != end; ++match)
    {
      parts_.push_back({std::string(begin, (*match)[0].first), (*match)[1],
                        (*match)[2].matched ? static_cast<std::size_t>(std::stoi((*match)[2])) : 1});
      rest += parts_.back().text_before;
      names.insert((*match)[1]);
      begin = (*match)[0].second;
    }
    tail_ = std::string(begin, text_.cend());
    rest += tail_;
    const bool enough = names.count("index") > 0 || names.count("row") + names.count("column") == 2;
    if (!enough || rest.find_first_of("{}") != std::string::npos)
    {
      fields.fail("pattern",
                  "a file name with {row} and {column}, or {index}, such as view_{row:02}_{column:02}.png "
                  "(:02 asks for two digits)");
    }
  }

  std::string name(const GridPosition& number, int index) const
  {
    std::string result;
    for (const Part& part : parts_)
    {
      const int value = part.field == "row" ? number.row : part.field == "column" ? number.column : index;
      result += part.text_before + padded(value, part.width);
    }
    return result + tail_;
  }

private:
  struct Part
  {
    std::string text_before;
    std::string field;
    std::size_t width;
  };

  std::string text_;
  std::vector<Part> parts_;
  std::string tail_;
};

/// {rows, columns} of a field.
cv::Size readGridSize(const YamlFields& fields, const std::string& name, const fs::path& file)
{
  const YamlFields grid(file, name, fields.node(name));
  grid.allowOnly({"rows", "columns"});
  const auto side = [&](const char* field)
  {
    const std::string wanted = "a whole number from 1 to " + std::to_string(MAX_GRID_SIDE);
    const int value = grid.get<int>(field, wanted).value_or(0);
    if (value < 1 || value > MAX_GRID_SIDE)
    {
      grid.fail(field, wanted);
    }
    return value;
  };
  return {side("columns"), side("rows")};
}

cv::Rect readGrid(const YamlFields& fields, const fs::path& file)
{
  const cv::Size size = readGridSize(fields, "grid", file);
  const std::string wanted =
      "[row, column], the numbers of the first view, from 0 to " + std::to_string(MAX_FIRST);
  const auto first = fields.integerPair("first", wanted).value_or(std::make_pair(0, 0));
  if (std::min(first.first, first.second) < 0 || std::max(first.first, first.second) > MAX_FIRST)
  {
    fields.fail("first", wanted);
  }
  return {{first.second, first.first}, size};
}

Flip readOrder(const YamlFields& fields)
{
  const auto is_reversed = [&](const char* field, const std::string& usual, const std::string& reversed)
  {
    const std::string wanted = "'" + usual + "' or '" + reversed + "'";
    const std::string value = fields.get<std::string>(field, wanted).value_or(usual);
    if (value != usual && value != reversed)
    {
      fields.fail(field, wanted);
    }
    return value == reversed;
  };
  const bool rows = is_reversed("row_order", "down", "up");
  const bool columns = is_reversed("column_order", "right", "left");
  if (rows && columns)
  {
    return Flip::Both;
  }
  return rows ? Flip::Rows : columns ? Flip::Columns : Flip::None;
}

/// The views of a pattern whose files are there: a grid may have gaps.
std::vector<ViewFile> findPatternViews(const fs::path& folder, const NamePattern& pattern,
                                       const cv::Rect& grid, int first_index)
{
  std::vector<ViewFile> views;
  for (int row = 0; row < grid.height; ++row)
  {
    for (int column = 0; column < grid.width; ++column)
    {
      const GridPosition number = {grid.y + row, grid.x + column};
      const fs::path path = folder / pattern.name(number, first_index + row * grid.width + column);
      if (isFile(path))
      {
        views.push_back({path, number, std::nullopt});
      }
    }
  }
  if (views.empty())
  {
    throw InputError("None of the " + std::to_string(grid.area()) + " views of '" + folder.string() +
                     "' is there; the first would be '" +
                     (folder / pattern.name({grid.y, grid.x}, first_index)).string() +
                     "'. Check pattern, grid and first in light_field.yaml.");
  }
  return views;
}

std::vector<ViewFile> readViewList(const fs::path& file, const YamlFields& fields)
{
  const YAML::Node list = fields.node("views");
  if (!list.IsSequence() || list.size() == 0)
  {
    fields.fail("views", "a list of {row, column, file, position_m}");
  }
  std::vector<ViewFile> views;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    const YamlFields entry(file, "views[" + std::to_string(i) + "]", list[i]);
    entry.allowOnly({"row", "column", "file", "position_m"});
    const auto row = entry.get<int>("row", "a whole number");
    const auto column = entry.get<int>("column", "a whole number");
    const auto name = entry.get<std::string>("file", "a file name");
    if (!row || !column || !name)
    {
      throw InputError("views[" + std::to_string(i) + "] in '" + file.string() +
                       "' lacks row, column or file; give all three.");
    }
    ViewFile view{file.parent_path() / *name, {*row, *column}, std::nullopt};
    if (!isFile(view.path))
    {
      throw InputError("The file '" + view.path.string() + "' of views[" + std::to_string(i) + "] in '" +
                       file.string() + "' is not there.");
    }
    if (const auto position = entry.numberPair("position_m", "[x, y] in metres"))
    {
      view.position = cv::Point2d(position->first, position->second);
    }
    views.push_back(view);
  }
  return views;
}

/// The distances of adjacent columns and rows in metres.
std::optional<std::pair<double, double>> readBaselines(const YamlFields& fields)
{
  const std::string wanted = "a positive length in metres, or [x, y]: between columns and between rows";
  if (!fields.has("baseline_m") || fields.node("baseline_m").IsSequence())
  {
    const auto baselines = fields.numberPair("baseline_m", wanted);
    if (baselines && !(baselines->first > 0.0 && baselines->second > 0.0))
    {
      fields.fail("baseline_m", wanted);
    }
    return baselines;
  }
  const auto baseline = fields.get<double>("baseline_m", wanted);
  if (!std::isfinite(*baseline) || *baseline <= 0.0)
  {
    fields.fail("baseline_m", wanted);
  }
  return std::make_pair(*baseline, *baseline);
}

std::optional<CameraDescription> readCamera(const YamlFields& fields, const fs::path& file,
                                            std::optional<double> baseline_m)
{
  const auto focal_length_px = fields.positive("focal_length_px");
  if (!focal_length_px)
  {
    for (const char* const field : {"principal_point_px", "focus_distance_m"})
    {
      if (fields.has(field))
      {
        throw InputError("'" + file.string() + "' has " + field +
                         " but no focal_length_px; depth needs both, so add it.");
      }
    }
    return std::nullopt;
  }
  if (!baseline_m)
  {
    throw InputError("'" + file.string() +
                     "' has focal_length_px but no baseline_m; depth needs both, so add it.");
  }
  CameraDescription camera;
  camera.focal_length_px = *focal_length_px;
  camera.baseline_m = *baseline_m;
  if (const auto point = fields.numberPair("principal_point_px", "[x, y] in pixels"))
  {
    camera.principal_point_px = cv::Point2d(point->first, point->second);
  }
  const std::string wanted = "a positive distance in metres, or .inf for parallel cameras";
  const auto focus_distance_m = fields.get<double>("focus_distance_m", wanted);
  if (focus_distance_m && !(*focus_distance_m > 0.0))
  {
    fields.fail("focus_distance_m", wanted);
  }
  if (focus_distance_m && std::isfinite(*focus_distance_m))
  {
    camera.focus_distance_m = focus_distance_m;
  }
  return camera;
}

std::optional<DisparityRange> readRange(const YamlFields& fields)
{
  const std::string wanted = "[smallest, largest] disparity in pixels between adjacent columns";
  const auto range = fields.numberPair("disparity_range", wanted);
  if (!range)
  {
    return std::nullopt;
  }
  if (!(range->first < range->second))
  {
    fields.fail("disparity_range", wanted);
  }
  return DisparityRange{static_cast<float>(range->first), static_cast<float>(range->second)};
}

std::optional<fs::path> readTruth(const YamlFields& fields, const fs::path& file)
{
  const auto name = fields.get<std::string>("truth", "the name of a PFM file");
  if (!name)
  {
    return std::nullopt;
  }
  fs::path path = file.parent_path() / *name;
  if (!isFile(path))
  {
    throw InputError("The file '" + path.string() + "' that '" + file.string() +
                     "' names as truth is not there.");
  }
  return path;
}

/// One image with all views: tiles or lenslets.
void readParts(const YamlFields& fields, const fs::path& file, FolderDescription& description)
{
  const bool has_tiles = fields.has("tiles");
  if (has_tiles == fields.has("lenslets") || fields.has("pattern") || fields.has("views") ||
      fields.has("grid"))
  {
    throw InputError(
        "'" + file.string() +
        "' names one image; say how its views lie in it with either tiles or lenslets: {rows, columns}, "
        "and leave out pattern, grid and views.");
  }
  const cv::Size grid = readGridSize(fields, has_tiles ? "tiles" : "lenslets", file);
  const fs::path path = file.parent_path() / *fields.get<std::string>("image", "the name of an image");
  if (!isFile(path))
  {
    throw InputError("The image '" + path.string() + "' that '" + file.string() + "' names is not there.");
  }
  for (int i = 0; i < grid.area(); ++i)
  {
    const GridPosition cell{i / grid.width, i % grid.width};
    ViewFile view{path, cell, {}};
    view.part = {has_tiles ? ViewPart::Kind::Tile : ViewPart::Kind::Lenslet, grid, cell};
    description.views.push_back(view);
  }
}

void readViews(const YamlFields& fields, const fs::path& file, FolderDescription& description)
{
  if (fields.has("image"))
  {
    readParts(fields, file, description);
    return;
  }
  const bool listed = fields.has("views");
  if (listed == fields.has("pattern") || (!listed && !fields.has("grid")))
  {
    throw InputError("'" + file.string() +
                     "' must say where the views are: either pattern and grid, or a list of views, or one "
                     "image.");
  }
  if (fields.has("grid"))
  {
    description.grid = readGrid(fields, file);
  }
  if (listed)
  {
    description.views = readViewList(file, fields);
    return;
  }
  const NamePattern pattern(fields, *fields.get<std::string>("pattern", "a file name"));
  const std::string wanted = "a whole number from 0 to " + std::to_string(MAX_FIRST);
  const int first_index = fields.get<int>("first_index", wanted).value_or(0);
  if (first_index < 0 || first_index > MAX_FIRST)
  {
    fields.fail("first_index", wanted);
  }
  description.views = findPatternViews(file.parent_path(), pattern, *description.grid, first_index);
}

}  // namespace

Recognition recognizeYaml(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  const fs::path yaml_file = listing.folder / DESCRIPTION_FILE;
  std::error_code error;
  const fs::file_type type = fs::status(yaml_file, error).type();
  if (type == fs::file_type::not_found)
  {
    return Recognition::no("there is none");
  }
  if (type != fs::file_type::regular && type != fs::file_type::unknown)
  {
    throw InputError("'" + yaml_file.string() + "' is not a regular file" +
                     (error ? ": " + error.message() : "") +
                     "; put a file with the description in its place.");
  }
  const YamlFields fields(yaml_file, "", loadYaml(yaml_file));
  fields.allowOnly({"pattern", "grid", "image", "tiles", "lenslets", "first", "first_index", "views",
                    "row_order", "column_order", "reference", "focal_length_px", "principal_point_px",
                    "baseline_m", "focus_distance_m", "disparity_range", "truth"});
  FolderDescription description;
  description.format = "yaml";
  readViews(fields, yaml_file, description);
  const std::string place = "[row, column] of a view";
  if (const auto reference = fields.integerPair("reference", place))
  {
    description.reference = GridPosition{reference->first, reference->second};
    if (!canBeCounted(*description.reference))
    {
      fields.fail("reference", place);
    }
  }
  if (fields.has("row_order") || fields.has("column_order"))
  {
    description.flip = readOrder(fields);
  }
  const auto baselines = readBaselines(fields);
  if (baselines)
  {
    description.step_length = baselines->first;
    description.row_step_ratio = baselines->second / baselines->first;
  }
  description.camera =
      readCamera(fields, yaml_file, baselines ? std::make_optional(baselines->first) : std::nullopt);
  description.disparity_range = readRange(fields);
  description.truth = readTruth(fields, yaml_file);
  return description;
}

}  // namespace light_field_depth
