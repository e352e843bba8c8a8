// Views whose names have a row and a column: 00_00, view_0_0_rgb, 0-0, IMG_0001_037_04_07, or 0000.

#include <algorithm>
#include <set>

#include "io/dataset_format.h"
#include "io/name_groups.h"

namespace light_field_depth
{
namespace
{
int toInt(long long number)
{
  return static_cast<int>(std::clamp<long long>(number, -10LL * MAX_NUMBER, 10LL * MAX_NUMBER));
}

FolderDescription describe(const ViewNames& names)
{
  FolderDescription description;
  description.format = "grid";
  description.place_claim = PlaceClaim::TwoNumbers;
  description.notes = leftOutNotes(names.left_out);
  return description;
}

/// Whether only the last of more than two numbers varies: 2024-05-01_12-00-00_17. It may count a row, or a
/// whole grid, which the images tell.
bool isIndexBesideOthers(const NameGroup& group)
{
  constexpr std::size_t MIN_VIEWS_OF_GRID = 4;  // 2 x 2
  const std::vector<std::size_t> varying = group.varying();
  const std::size_t numbers = group.names.front().numbers.size();
  return numbers > 2 && varying.size() == 1 && varying.front() + 1 == numbers &&
         group.names.size() >= MIN_VIEWS_OF_GRID;
}

/// The one number that varies, if all names write it with 2 or 4 digits.
struct DigitPlace
{
  std::size_t place = 0;
  long long columns = 0;  ///< 10 or 100: what a row counts
};

std::optional<DigitPlace> digitPlaceIn(const NameGroup& group)
{
  const std::vector<std::size_t> varying = group.varying();
  if (varying.size() != 1)
  {
    return std::nullopt;
  }
  const std::size_t place = varying.front();
  const std::size_t digits = group.names.front().digits[place];
  const bool same = std::all_of(group.names.begin(), group.names.end(),
                                [&](const NumberedName& name)
                                { return name.digits[place] == digits && name.numbers[place] >= 0; });
  if (!same || (digits != 2 && digits != 4))
  {
    return std::nullopt;
  }
  return DigitPlace{place, digits == 4 ? 100 : 10};
}

}  // namespace

Recognition recognizeRowsAndColumns(const FolderListing& listing, const DatasetOptions& options)
{
  const auto names = viewNames(listing.folder, listing.images);
  if (!names)
  {
    return Recognition::no("no name has a number");
  }
  const auto places = rowAndColumnIn(names->group);
  if (!places)
  {
    return Recognition::no("no two numbers of " + names->group.form + " make a grid");
  }
  if (options.grid && names->group.varying().size() == 1)
  {
    return Recognition::no("--grid says that one number names the views");
  }
  if (isIndexBesideOthers(names->group))
  {
    return Recognition::no("one of several numbers counts the images");
  }
  FolderDescription description = describe(*names);
  for (const NumberedName& name : names->group.names)
  {
    description.views.push_back(
        {name.path, {toInt(name.numbers[places->first]), toInt(name.numbers[places->second])}, {}});
  }
  readGridParameters(listing.folder, description);
  return description;
}

Recognition recognizeFourDigits(const FolderListing& listing, const DatasetOptions& options)
{
  const auto names = viewNames(listing.folder, listing.images);
  const auto digits = names ? digitPlaceIn(names->group) : std::nullopt;
  if (!digits)
  {
    return Recognition::no("the names do not differ in two or four digits alone");
  }
  std::set<long long> numbers;
  std::set<long long> rows;
  std::set<long long> columns;
  for (const NumberedName& name : names->group.names)
  {
    const long long number = name.numbers[digits->place];
    numbers.insert(number);
    rows.insert(number / digits->columns);
    columns.insert(number % digits->columns);
  }
  // An index runs on without a gap, from 0099 to 0100; rows of columns begin anew. Within one hundred it may
  // have gaps, too, where views are missing: the images tell a single row from a grid.
  const bool crosses = std::any_of(
      numbers.begin(), numbers.end(),
      [&](long long number) { return (number + 1) % digits->columns == 0 && numbers.count(number + 1) > 0; });
  const bool runs_on = *numbers.rbegin() - *numbers.begin() + 1 == static_cast<long long>(numbers.size()) ||
                       (digits->columns == 100 && (crosses || rows.size() == 1));
  if (options.grid || runs_on || (rows.size() > 1 && columns.size() == 1 && rows.size() == numbers.size()))
  {
    return Recognition::no("the numbers run on like an index");
  }
  // Four bare digits are row and column also where views are missing, other numbers only if they fill a grid.
  const auto is_dense = [](const std::set<long long>& counted)
  { return *counted.rbegin() - *counted.begin() + 1 == static_cast<long long>(counted.size()); };
  const bool is_full = rows.size() > 1 && rows.size() * columns.size() == numbers.size() && is_dense(rows) &&
                       is_dense(columns);
  if (!is_full && (names->group.form != "#" || digits->columns != 100))
  {
    return Recognition::no("the numbers do not fill a grid of rows and columns");
  }
  FolderDescription description = describe(*names);
  for (const NumberedName& name : names->group.names)
  {
    const long long number = name.numbers[digits->place];
    description.views.push_back(
        {name.path, {toInt(number / digits->columns), toInt(number % digits->columns)}, {}});
  }
  return description;
}

}  // namespace light_field_depth
