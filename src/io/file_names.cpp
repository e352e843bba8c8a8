// Datasets whose files tell the place of each view by their names.

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <system_error>

#include "io/folder_description.h"
#include "io/number_text.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr int HCI_GRID_SIDE = 9;
constexpr const char* HCI_PARAMETERS = "parameters.cfg";
constexpr const char* HCI_TRUTH = "gt_disp_lowres.pfm";

enum class NameKind
{
  Hci,
  Stanford,
  RowColumn,  ///< RR_CC, with or without a prefix
  FourDigits  ///< RRCC
};

/// What a file's name says.
struct ParsedName
{
  NameKind kind;
  std::string prefix;  ///< of RR_CC
  fs::path path;
  int index = 0;  ///< of HCI
  GridPosition number;
  std::optional<cv::Point2d> position;
};

std::string patternText(const ParsedName& name)
{
  switch (name.kind)
  {
    case NameKind::Hci:
      return "input_Cam%03d";
    case NameKind::Stanford:
      return "out_RR_CC_Y_X";
    case NameKind::RowColumn:
      return name.prefix + "RR_CC";
    case NameKind::FourDigits:
      break;
  }
  return "RRCC";
}

std::optional<ParsedName> parseName(const fs::path& path)
{
  static const std::regex hci(R"(input_Cam(\d{1,6}))");
  static const std::regex stanford(
      R"(out_(\d{1,3})_(\d{1,3})_(-?\d{1,9}(?:\.\d*)?)_(-?\d{1,9}(?:\.\d*)?)_?)");
  static const std::regex row_column(R"((|.*\D)(\d{1,3})_(\d{1,3}))");
  static const std::regex four_digits(R"((\d\d)(\d\d))");
  const std::string stem = path.stem().string();
  std::smatch match;
  ParsedName name;
  name.path = path;
  if (std::regex_match(stem, match, hci))
  {
    name.kind = NameKind::Hci;
    name.index = std::stoi(match[1]);
    return name;
  }
  if (std::regex_match(stem, match, stanford))
  {
    name.kind = NameKind::Stanford;
    name.number = {std::stoi(match[1]), std::stoi(match[2])};
    name.position = cv::Point2d(*numberFromText<double>(match[4]), *numberFromText<double>(match[3]));
    return name;
  }
  if (std::regex_match(stem, match, row_column))
  {
    name.kind = NameKind::RowColumn;
    name.prefix = match[1];
    name.number = {std::stoi(match[2]), std::stoi(match[3])};
    return name;
  }
  if (std::regex_match(stem, match, four_digits))
  {
    name.kind = NameKind::FourDigits;
    name.number = {std::stoi(match[1]), std::stoi(match[2])};
    return name;
  }
  return std::nullopt;
}

std::vector<fs::path> imageFiles(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const bool hidden = entry->path().filename().string().front() == '.';
    if (!hidden && isImageFile(entry->path()) && entry->is_regular_file())
    {
      files.push_back(entry->path());
    }
  }
  if (error)
  {
    throw InputError("The folder '" + folder.string() + "' cannot be read: " + error.message() + ".");
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<ParsedName> parseNames(const fs::path& folder)
{
  const std::vector<fs::path> files = imageFiles(folder);
  if (files.empty())
  {
    throw InputError("The folder '" + folder.string() + "' has no images in it (" + imageFormatsText() +
                     "); name the folder that holds the views.");
  }
  std::vector<ParsedName> names;
  for (const fs::path& file : files)
  {
    if (const auto name = parseName(file))
    {
      names.push_back(*name);
    }
  }
  if (names.empty())
  {
    throw InputError("None of the " + std::to_string(files.size()) + " image(s) in '" + folder.string() +
                     "' (the first is '" + files.front().filename().string() +
                     "') is named like a view: input_Cam%03d, RR_CC with or without a prefix, RRCC or "
                     "out_RR_CC_Y_X; rename the views or describe them in a light_field.yaml.");
  }
  return names;
}

void requireOnePattern(const fs::path& folder, const std::vector<ParsedName>& names)
{
  for (const ParsedName& name : names)
  {
    if (patternText(name) != patternText(names.front()))
    {
      throw InputError("The folder '" + folder.string() + "' mixes two datasets: '" +
                       names.front().path.filename().string() + "' is named " + patternText(names.front()) +
                       ", '" + name.path.filename().string() + "' is named " + patternText(name) +
                       "; keep one of them in the folder.");
    }
  }
}

void describeHci(const fs::path& folder, std::vector<ParsedName>& names, FolderDescription& description)
{
  description.format = "hci";
  description.grid = cv::Rect(0, 0, HCI_GRID_SIDE, HCI_GRID_SIDE);
  const fs::path cfg_file = folder / HCI_PARAMETERS;
  const bool has_cfg = fs::exists(cfg_file);
  if (has_cfg)
  {
    readHciParameters(cfg_file, description);
  }
  const cv::Rect grid = *description.grid;
  for (ParsedName& name : names)
  {
    if (name.index >= grid.area())
    {
      throw InputError("The view '" + name.path.filename().string() + "' lies outside of the grid of " +
                       std::to_string(grid.height) + " x " + std::to_string(grid.width) + " views that " +
                       (has_cfg ? cfg_file.string() + " states" : "is assumed without a parameters.cfg") +
                       "; set num_cams_x and num_cams_y under [extrinsics] in parameters.cfg.");
    }
    name.number = {name.index / grid.width, name.index % grid.width};
  }
  if (fs::exists(folder / HCI_TRUTH))
  {
    description.truth = folder / HCI_TRUTH;
  }
}

}  // namespace

FolderDescription describeByNames(const fs::path& folder)
{
  std::vector<ParsedName> names = parseNames(folder);
  requireOnePattern(folder, names);
  FolderDescription description;
  switch (names.front().kind)
  {
    case NameKind::Hci:
      describeHci(folder, names, description);
      break;
    case NameKind::Stanford:
      description.format = "stanford";
      break;
    case NameKind::RowColumn:
    case NameKind::FourDigits:
      description.format = "grid";
      break;
  }
  for (const ParsedName& name : names)
  {
    description.views.push_back({name.path, name.number, name.position});
  }
  return description;
}

}  // namespace light_field_depth
