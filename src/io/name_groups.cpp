#include "io/name_groups.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// More digits than this make no row, column or index; the number is cut there.
constexpr std::size_t MAX_DIGITS = 15;

/// Two numbers are row and column if they fill at least this part of the rectangle they span: a cross of
/// 9 x 9 fills 0.21.
constexpr double MIN_FILLED_PART = 0.1;

constexpr std::array<std::string_view, 30> OTHER_WORDS = {
    "thumb",   "thumbs", "thumbnail", "thumbnails", "preview",      "icon",       "mask",       "masks",
    "truth",   "gt",     "disp",      "disparity",  "depth",        "depths",     "alpha",      "normal",
    "normals", "label",  "labels",    "seg",        "segmentation", "conf",       "confidence", "flow",
    "occ",     "nonocc", "occlusion", "objectids",  "boundaries",   "groundtruth"};

bool isDigit(char letter)
{
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

bool isLetter(char letter)
{
  return std::isalpha(static_cast<unsigned char>(letter)) != 0;
}

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

std::set<long long> numbersAt(const NameGroup& group, std::size_t place)
{
  std::set<long long> numbers;
  for (const NumberedName& name : group.names)
  {
    numbers.insert(name.numbers[place]);
  }
  return numbers;
}

double spanAt(const NameGroup& group, std::size_t place)
{
  const std::set<long long> numbers = numbersAt(group, place);
  return static_cast<double>(*numbers.rbegin() - *numbers.begin()) + 1.0;
}

bool pairsAreUnique(const NameGroup& group, std::size_t first, std::size_t second)
{
  // Two files of one place differ in their endings alone, or in numbers that are neither row nor column.
  std::map<std::pair<long long, long long>, const NumberedName*> seen;
  for (const NumberedName& name : group.names)
  {
    const auto [entry, is_new] = seen.insert({{name.numbers[first], name.numbers[second]}, &name});
    if (!is_new && entry->second->numbers != name.numbers)
    {
      return false;
    }
  }
  return true;
}

std::string quoted(const fs::path& path)
{
  return "'" + path.filename().string() + "'";
}

[[noreturn]] void refuseMixture(const fs::path& folder, const NameGroup& a, const NameGroup& b)
{
  throw InputError("The folder '" + folder.string() +
                   "' mixes two datasets: " + quoted(a.names.front().path) + " is named " + a.form + ", " +
                   quoted(b.names.front().path) + " is named " + b.form +
                   "; keep one of them in the folder.");
}

/// Where a single letter stands by itself in a name: the A of camA, of cam_A and of cam_A1. The last such
/// place.
std::optional<std::size_t> letterIn(const std::string& stem)
{
  const auto is_upper = [](char letter) { return std::isupper(static_cast<unsigned char>(letter)) != 0; };
  for (std::size_t i = stem.size(); i-- > 0;)
  {
    const bool begins = i == 0 || !isLetter(stem[i - 1]) || (is_upper(stem[i]) && !is_upper(stem[i - 1]));
    const bool ends = i + 1 == stem.size() || !isLetter(stem[i + 1]);
    if (isLetter(stem[i]) && begins && ends)
    {
      return i;
    }
  }
  return std::nullopt;
}

/// The name with a number in the place of that letter: cam_B1 becomes cam_2_1.
fs::path withNumberForLetter(const fs::path& path, std::size_t place)
{
  std::string stem = path.stem().string();
  const int number = std::tolower(static_cast<unsigned char>(stem[place])) - 'a' + 1;
  const bool is_followed = place + 1 < stem.size() && isDigit(stem[place + 1]);
  stem.replace(place, 1, "_" + std::to_string(number) + (is_followed ? "_" : ""));
  return path.parent_path() / (stem + path.extension().string());
}

/// Whether letters count the views: at least three of them, in names that are equal beside them and their
/// numbers. Two letters may be a left and a right one.
bool areCountedByLetters(const std::vector<fs::path>& paths)
{
  constexpr std::size_t MIN_LETTERS = 3;
  std::set<std::string> forms;
  std::set<char> letters;
  for (const fs::path& path : paths)
  {
    const std::string stem = path.stem().string();
    if (saysNoView(stem))
    {
      continue;
    }
    const std::optional<std::size_t> place = letterIn(stem);
    if (!place || stem.size() == 1)  // bare letters may name anything
    {
      return false;
    }
    letters.insert(static_cast<char>(std::tolower(static_cast<unsigned char>(stem[*place]))));
    forms.insert(takeApart(withNumberForLetter(path, *place)).form);
  }
  return forms.size() == 1 && letters.size() >= MIN_LETTERS;
}

/// Whether a smaller group could as well be the light field.
bool isRival(const NameGroup& group, const NameGroup& largest)
{
  return group.names.front().numbers.size() >= 2 || group.names.size() == largest.names.size() ||
         group.form == "input_cam#";
}

}  // namespace

NumberedName takeApart(const fs::path& path)
{
  NumberedName name;
  name.path = path;
  const std::string stem = lower(path.stem().string());
  std::size_t i = 0;
  while (i < stem.size())
  {
    const bool has_sign = stem[i] == '-' && i + 1 < stem.size() && isDigit(stem[i + 1]) &&
                          (i == 0 || !(isDigit(stem[i - 1]) || isLetter(stem[i - 1])));
    if (!has_sign && !isDigit(stem[i]))
    {
      name.form += stem[i++];
      continue;
    }
    const std::size_t begin = i + (has_sign ? 1 : 0);
    i = std::min(stem.find_first_not_of("0123456789", begin), stem.size());
    const long long value = std::stoll(stem.substr(begin, std::min(i - begin, MAX_DIGITS)));
    name.numbers.push_back(has_sign ? -value : value);
    name.digits.push_back(i - begin);
    name.form += '#';
  }
  return name;
}

std::vector<std::size_t> NameGroup::varying() const
{
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < names.front().numbers.size(); ++place)
  {
    if (numbersAt(*this, place).size() > 1)
    {
      places.push_back(place);
    }
  }
  return places;
}

std::optional<std::pair<std::size_t, std::size_t>> rowAndColumnIn(const NameGroup& group)
{
  const std::vector<std::size_t> varying = group.varying();
  const std::size_t count = group.names.front().numbers.size();
  // A single row or column, or a single view: the number beside it has as many digits and is the same in all.
  if (varying.size() <= 1)
  {
    const std::size_t second = varying.empty() ? count - 1 : std::max<std::size_t>(varying.front(), 1);
    const auto& digits = group.names.front().digits;
    const bool is_pair = count >= 2 && digits[second - 1] == digits[second] && digits[second] <= 3;
    return is_pair ? std::make_optional(std::make_pair(second - 1, second)) : std::nullopt;
  }
  // Of several that fill their grids alike, those with the fewest gaps: exposures and the like have many.
  std::optional<std::pair<std::size_t, std::size_t>> best;
  double best_part = MIN_FILLED_PART;
  double best_span = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < varying.size(); ++i)
  {
    for (std::size_t j = i + 1; j < varying.size(); ++j)
    {
      const auto rows = static_cast<double>(numbersAt(group, varying[i]).size());
      const auto columns = static_cast<double>(numbersAt(group, varying[j]).size());
      const double part = static_cast<double>(group.names.size()) / (rows * columns);
      const double span = spanAt(group, varying[i]) * spanAt(group, varying[j]);
      if ((part > best_part || (part == best_part && span <= best_span)) &&
          pairsAreUnique(group, varying[i], varying[j]))
      {
        best_part = part;
        best_span = span;
        best = std::make_pair(varying[i], varying[j]);
      }
    }
  }
  return best;
}

bool saysNoView(const std::string& name)
{
  std::string word;
  for (const char letter : lower(name) + " ")
  {
    if (isLetter(letter))
    {
      word += letter;
      continue;
    }
    if (std::find(OTHER_WORDS.begin(), OTHER_WORDS.end(), word) != OTHER_WORDS.end())
    {
      return true;
    }
    word.clear();
  }
  return false;
}

std::optional<ViewNames> viewNames(const fs::path& folder, const std::vector<fs::path>& paths)
{
  std::map<std::string, NameGroup> groups;
  ViewNames views;
  const bool by_letters = areCountedByLetters(paths);
  for (const fs::path& path : paths)
  {
    const std::optional<std::size_t> letter = by_letters ? letterIn(path.stem().string()) : std::nullopt;
    NumberedName name = takeApart(letter ? withNumberForLetter(path, *letter) : path);
    name.path = path;
    if (name.numbers.empty())
    {
      views.left_out.push_back(path);
      continue;
    }
    NameGroup& group = groups[name.form];
    group.form = name.form;
    group.names.push_back(std::move(name));
  }
  const auto is_view = [](const auto& entry) { return !saysNoView(entry.first); };
  const bool all_say_no = std::none_of(groups.begin(), groups.end(), is_view);
  const NameGroup* largest = nullptr;
  for (const auto& entry : groups)
  {
    const bool counts = all_say_no || is_view(entry);
    if (counts && (largest == nullptr || entry.second.names.size() > largest->names.size()))
    {
      largest = &entry.second;
    }
  }
  if (largest == nullptr)
  {
    return std::nullopt;
  }
  for (const auto& entry : groups)
  {
    if (&entry.second == largest)
    {
      continue;
    }
    if ((all_say_no || is_view(entry)) && isRival(entry.second, *largest))
    {
      refuseMixture(folder, *largest, entry.second);
    }
    for (const NumberedName& name : entry.second.names)
    {
      views.left_out.push_back(name.path);
    }
  }
  views.group = *largest;
  return views;
}

std::vector<std::string> leftOutNotes(const std::vector<fs::path>& left_out)
{
  if (left_out.empty())
  {
    return {};
  }
  const std::string more =
      left_out.size() == 1 ? " is" : " and " + std::to_string(left_out.size() - 1) + " more are";
  return {quoted(left_out.front()) + more + " left out: not named like the views."};
}

}  // namespace light_field_depth
