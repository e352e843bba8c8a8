#include "view_order.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "light_field_depth/core/depth_sign.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/core/view_layout.h"
#include "light_field_depth/io/dataset.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
struct NamedField
{
  std::string name;
  LightField light_field;
};

/// "FOLDER" or "FOLDER,FLIP".
NamedField readField(const std::string& text, int threads)
{
  const std::size_t comma = text.rfind(',');
  DatasetOptions options;
  options.threads = threads;
  if (comma != std::string::npos)
  {
    options.flip = flipFromString(text.substr(comma + 1));
  }
  const std::filesystem::path folder = text.substr(0, comma);
  return {folder.filename().string(), readDataset(folder, options).light_field};
}

/// The views that stand at most so many grid steps from the reference; nothing if they are all, or too few.
std::optional<LightField> within(const LightField& light_field, int reach)
{
  const GridPosition centre = light_field.reference().grid;
  std::vector<View> views;
  std::copy_if(light_field.views.begin(), light_field.views.end(), std::back_inserter(views),
               [&](const View& view)
               {
                 return std::abs(view.grid.row - centre.row) <= reach &&
                        std::abs(view.grid.column - centre.column) <= reach;
               });
  if (views.size() == light_field.views.size() || views.size() < 3)
  {
    return std::nullopt;
  }
  return makeLightField(views, centre);
}

std::vector<NamedField> subsetsOf(const LightField& light_field)
{
  std::vector<NamedField> subsets = {{"all", light_field}};
  for (const int reach : {2, 1})
  {
    if (const auto part = within(light_field, reach))
    {
      const std::string side = std::to_string(2 * reach + 1);
      subsets.push_back({side + " x " + side, *part});
    }
  }
  for (const ViewSelection selection : {ViewSelection::Cross, ViewSelection::Row, ViewSelection::Column})
  {
    subsets.push_back({toString(selection), selectViews(light_field, selection)});
  }
  return subsets;
}

/// What findLayout() has to say of a light field in the right order that was relabelled so.
GridLayout expectedLayout(const GridSymmetry& symmetry, const LightField& claimed)
{
  const GridPosition centre = claimed.reference().grid;
  const auto is_on_row = [&](const View& view) { return view.grid.row == centre.row; };
  const auto is_on_column = [&](const View& view) { return view.grid.column == centre.column; };
  const bool line = std::all_of(claimed.views.begin(), claimed.views.end(), is_on_row) ||
                    std::all_of(claimed.views.begin(), claimed.views.end(), is_on_column);
  return {symmetry.transposed, !line && symmetry.rows_reversed != symmetry.columns_reversed};
}

struct Count
{
  int right = 0;
  int wrong = 0;
  int undecided = 0;
  double least_ratio = 1e9;
  double least_significance = 1e9;
  double worst_match = 0.0;
  std::vector<double> milliseconds;
};

void add(const FoundLayout& found, const GridLayout& expected, Count& count)
{
  if (!found.decided)
  {
    ++count.undecided;
  }
  else
  {
    ++(found.layout == expected ? count.right : count.wrong);
  }
  count.least_ratio = std::min(count.least_ratio, found.ratio);
  count.least_significance = std::min(count.least_significance, found.significance);
  count.worst_match = std::max(count.worst_match, found.match);
}

Count countOf(const LightField& light_field, ThreadPool& pool)
{
  Count count;
  for (const GridSymmetry& symmetry : allGridSymmetries())
  {
    const LightField claimed = relabelled(light_field, symmetry);
    FoundLayout found;
    count.milliseconds.push_back(millisecondsOf([&] { found = findLayout(claimed, pool); }));
    add(found, expectedLayout(symmetry, claimed), count);
  }
  return count;
}

}  // namespace

void measureViewOrder(const Settings& settings)
{
  Table table;
  table.header = {"light field", "views",        "right", "wrong", "undecided",
                  "ratio",       "significance", "match", "ms"};
  table.note =
      "Each in its eight symmetries; of a row or column the direction is left open. The least ratio and "
      "significance, and the worst match, of the eight; the median time of one.";
  nlohmann::ordered_json json = describeMachine(settings);
  ThreadPool pool(settings.threads);
  Count total;
  std::vector<std::string> folders = settings.inputs;
  folders.insert(folders.end(), settings.captures.begin(), settings.captures.end());
  for (const std::string& folder : folders)
  {
    const NamedField field = readField(folder, settings.threads);
    for (const NamedField& subset : subsetsOf(field.light_field))
    {
      const Count count = countOf(subset.light_field, pool);
      table.rows.push_back({field.name, subset.name, std::to_string(count.right), std::to_string(count.wrong),
                            std::to_string(count.undecided), fixed(count.least_ratio, 3),
                            fixed(count.least_significance, 1), fixed(count.worst_match, 2),
                            fixed(median(count.milliseconds), 1)});
      json["rows"].push_back({{"light_field", field.name},
                              {"views", subset.name},
                              {"right", count.right},
                              {"wrong", count.wrong},
                              {"undecided", count.undecided}});
      total.right += count.right;
      total.wrong += count.wrong;
      total.undecided += count.undecided;
    }
  }
  table.rows.push_back({"all", "", std::to_string(total.right), std::to_string(total.wrong),
                        std::to_string(total.undecided), "", "", "", ""});
  publish(settings, "view_order", table, json);
}

}  // namespace light_field_depth::benchmark
