// Views whose names have a row and a column: 00_00, view_0_0_rgb, 0-0, IMG_0001_037_04_07, or 0000.

#include <algorithm>
#include <set>

#include "io/dataset_format.h"
#include "io/name_groups.h"

namespace light_field_depth
{
namespace
{
constexpr long long HUNDRED = 100;
constexpr std::size_t FOUR = 4;

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
  FolderDescription description = describe(*names);
  for (const NumberedName& name : names->group.names)
  {
    description.views.push_back(
        {name.path, {toInt(name.numbers[places->first]), toInt(name.numbers[places->second])}, {}});
  }
  return description;
}

Recognition recognizeFourDigits(const FolderListing& listing, const DatasetOptions& options)
{
  const auto names = viewNames(listing.folder, listing.images);
  if (!names || names->group.form != "#")
  {
    return Recognition::no("the names are not four digits");
  }
  std::set<long long> numbers;
  std::set<long long> rows;
  std::set<long long> columns;
  for (const NumberedName& name : names->group.names)
  {
    if (name.digits.front() != FOUR || name.numbers.front() < 0)
    {
      return Recognition::no("'" + name.path.filename().string() + "' has not four digits");
    }
    numbers.insert(name.numbers.front());
    rows.insert(name.numbers.front() / HUNDRED);
    columns.insert(name.numbers.front() % HUNDRED);
  }
  // An index runs on without a gap, from 0099 to 0100; rows of columns begin anew.
  const bool runs_on = *numbers.rbegin() - *numbers.begin() + 1 == static_cast<long long>(numbers.size());
  if (options.grid || runs_on || (rows.size() > 1 && columns.size() == 1 && rows.size() == numbers.size()))
  {
    return Recognition::no("the numbers run on like an index");
  }
  FolderDescription description = describe(*names);
  for (const NumberedName& name : names->group.names)
  {
    description.views.push_back(
        {name.path, {toInt(name.numbers.front() / HUNDRED), toInt(name.numbers.front() % HUNDRED)}, {}});
  }
  return description;
}

}  // namespace light_field_depth
