// param.txt of the Cambridge synthetic light fields: num_x, num_y, base_x, base_y, one beside the views of a
// grid.

#include <cmath>
#include <locale>
#include <map>
#include <regex>
#include <sstream>

#include "io/folder_description.h"
#include "io/folder_listing.h"
#include "io/number_text.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
/// Steps that differ more make no grid that is worth matching in both directions.
constexpr double MAX_STEP_RATIO = 10.0;

/// The numbers by their names, however they are written: "num_x 9", "num_x = 9", "num_x: 9".
std::map<std::string, double> namedNumbers(const std::string& text)
{
  static const std::regex form(R"re(\s*"?([A-Za-z_]{1,40})"?\s*[:=,]?\s*([-+0-9.eE]{1,40})\s*[,;]?\s*)re");
  constexpr std::size_t MAX_LINE = 200;
  std::map<std::string, double> numbers;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    std::smatch match;
    if (line.size() > MAX_LINE || !std::regex_match(line, match, form))
    {
      continue;
    }
    const auto number = numberFromText<double>(match[2]);
    if (number && std::isfinite(*number))
    {
      numbers[match[1]] = *number;
    }
  }
  return numbers;
}

double valueOf(const std::map<std::string, double>& numbers, const char* name)
{
  const auto found = numbers.find(name);
  return found != numbers.end() ? found->second : 0.0;
}

/// The grid of so many columns and rows in which all views lie, counted from 0 or from 1.
std::optional<cv::Rect> gridAround(const std::vector<ViewFile>& views, const cv::Size& size)
{
  cv::Rect span(views.front().number.column, views.front().number.row, 1, 1);
  for (const ViewFile& view : views)
  {
    span |= cv::Rect(view.number.column, view.number.row, 1, 1);
  }
  for (const int first : {0, 1})
  {
    const cv::Rect grid({first, first}, size);
    if ((grid & span) == span)
    {
      return grid;
    }
  }
  return std::nullopt;
}

}  // namespace

void readGridParameters(const std::filesystem::path& folder, FolderDescription& description)
{
  const std::filesystem::path file = folder / "param.txt";
  if (!isFile(file) || description.views.empty())
  {
    return;
  }
  const std::map<std::string, double> numbers = namedNumbers(readFile(file));
  const double columns = valueOf(numbers, "num_x");
  const double rows = valueOf(numbers, "num_y");
  const auto can_be_counted = [](double number) { return number >= 1.0 && number <= MAX_NUMBER; };
  std::string said;
  if (can_be_counted(columns) && can_be_counted(rows))
  {
    const cv::Size size(static_cast<int>(columns), static_cast<int>(rows));
    const auto grid = gridAround(description.views, size);
    const std::string text = std::to_string(size.height) + " x " + std::to_string(size.width);
    if (!grid)
    {
      description.warnings.push_back("param.txt says that there are " + text +
                                     " views (rows x columns), but the names have others; the names count.");
    }
    else
    {
      description.grid = grid;
      said = "a grid of " + text + " (rows x columns)";
    }
  }
  const double across = valueOf(numbers, "base_x");
  const double down = valueOf(numbers, "base_y");
  const double ratio = across > 0.0 ? down / across : 0.0;
  if (ratio >= 1.0 / MAX_STEP_RATIO && ratio <= MAX_STEP_RATIO)
  {
    description.row_step_ratio = ratio;
    std::ostringstream steps;
    steps.imbue(std::locale::classic());
    steps << (said.empty() ? "" : ", ") << "steps of " << across << " between columns and " << down
          << " between rows, of an unknown unit";
    said += steps.str();
  }
  if (!said.empty())
  {
    description.notes.push_back("param.txt states " + said +
                                "; it has no focal length: --focal-length and --baseline give metres.");
  }
}

}  // namespace light_field_depth
