// Views that are counted by one number: 000, lowtoys001, view0 .. view6.

#include <algorithm>

#include "io/dataset_format.h"
#include "io/name_groups.h"

namespace light_field_depth
{
namespace
{
/// Numbers with more gaps than this are stamps of time and the like: only their order counts.
constexpr long long MAX_SPAN_OVER_COUNT = 12;

/// The number that tells all files apart with the fewest gaps, as stamps of time have many; the last of
/// several.
std::optional<std::size_t> indexPlace(const NameGroup& group)
{
  const std::vector<std::size_t> varying = group.varying();
  std::optional<std::size_t> best;
  long long best_span = 0;
  for (auto place = varying.rbegin(); place != varying.rend(); ++place)
  {
    std::vector<long long> numbers;
    for (const NumberedName& name : group.names)
    {
      numbers.push_back(name.numbers[*place]);
    }
    std::sort(numbers.begin(), numbers.end());
    const bool unique = std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
    const long long span = numbers.back() - numbers.front();
    if (unique && (!best || span < best_span))
    {
      best = *place;
      best_span = span;
    }
  }
  return best;
}

}  // namespace

Recognition recognizeIndex(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  auto names = viewNames(listing.folder, listing.images);
  if (!names)
  {
    return Recognition::no("no name has a number");
  }
  const auto place = indexPlace(names->group);
  if (!place)
  {
    return Recognition::no("no number of " + names->group.form + " tells the images apart");
  }
  std::vector<NumberedName>& files = names->group.names;
  const std::size_t index = *place;
  std::sort(files.begin(), files.end(),
            [&](const NumberedName& a, const NumberedName& b)
            { return a.numbers[index] < b.numbers[index]; });
  const long long first = files.front().numbers[index];
  const long long span = files.back().numbers[index] - first + 1;
  // Two views are neighbours, whatever their numbers.
  const bool by_order =
      files.size() == 2 || span > MAX_SPAN_OVER_COUNT * static_cast<long long>(files.size());
  FolderDescription description;
  description.format = "index";
  description.place_claim = PlaceClaim::SingleNumber;
  description.first_number = by_order ? 0 : static_cast<int>(std::clamp<long long>(first, 0, MAX_NUMBER));
  description.notes = leftOutNotes(names->left_out);
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const long long number = by_order ? static_cast<long long>(i) : files[i].numbers[index] - first;
    description.views.push_back({files[i].path, {0, static_cast<int>(number)}, {}});
  }
  return description;
}

}  // namespace light_field_depth
