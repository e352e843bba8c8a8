// Views whose names say where they stand: left.png and right.png, scene_L.png and scene_R.png, left, center
// and right, top_left .. bottom_right, north, south, east, west and center, also one set for each frame.

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "io/dataset_format.h"
#include "io/frame_choice.h"
#include "io/name_groups.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// What a word says of a place: rows from -1 (top) to 1, columns from -1 (left) to 1.
struct PlaceWord
{
  std::string_view word;
  int row;
  int column;
};

constexpr std::array<PlaceWord, 32> PLACE_WORDS = {{
    {"left", 0, -1},       {"l", 0, -1},     {"west", 0, -1},       {"right", 0, 1},
    {"r", 0, 1},           {"east", 0, 1},   {"top", -1, 0},        {"upper", -1, 0},
    {"up", -1, 0},         {"north", -1, 0}, {"bottom", 1, 0},      {"lower", 1, 0},
    {"down", 1, 0},        {"south", 1, 0},  {"topleft", -1, -1},   {"tl", -1, -1},
    {"northwest", -1, -1}, {"nw", -1, -1},   {"topright", -1, 1},   {"tr", -1, 1},
    {"northeast", -1, 1},  {"ne", -1, 1},    {"bottomleft", 1, -1}, {"bl", 1, -1},
    {"southwest", 1, -1},  {"sw", 1, -1},    {"bottomright", 1, 1}, {"br", 1, 1},
    {"southeast", 1, 1},   {"se", 1, 1},     {"upperleft", -1, -1}, {"upperright", -1, 1},
}};

/// They count only where no other word of the name says a place.
constexpr std::array<std::string_view, 6> MIDDLE_WORDS = {"center", "centre", "middle", "mid", "c", "m"};

bool isLetter(char letter)
{
  return std::isalpha(static_cast<unsigned char>(letter)) != 0;
}

/// The words of a name and what stands between them, in order: a word ends where letters end, and before a
/// capital behind a small letter, so that imgL has two.
std::vector<std::string> partsOf(const std::string& name)
{
  const auto is_small = [](char letter) { return std::islower(static_cast<unsigned char>(letter)) != 0; };
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    const bool goes_on =
        i > 0 && isLetter(name[i]) && isLetter(name[i - 1]) && !(is_small(name[i - 1]) && !is_small(name[i]));
    if (!goes_on)
    {
      parts.emplace_back();
    }
    parts.back() += name[i];
  }
  return parts;
}

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

const PlaceWord* placeWord(const std::string& part)
{
  const auto* const found =
      std::find_if(PLACE_WORDS.begin(), PLACE_WORDS.end(),
                   [word = lower(part)](const PlaceWord& place) { return place.word == word; });
  return found == PLACE_WORDS.end() ? nullptr : found;
}

bool isMiddleWord(const std::string& part)
{
  return std::find(MIDDLE_WORDS.begin(), MIDDLE_WORDS.end(), lower(part)) != MIDDLE_WORDS.end();
}

/// Puts # for a word; words with nothing but signs between them are one.
void appendPlace(std::string& rest)
{
  const std::size_t last = rest.find_last_not_of("_-. ");
  if (last != std::string::npos && rest[last] == '#')
  {
    rest.resize(last + 1);
    return;
  }
  rest += '#';
}

struct NamedPlace
{
  std::string rest;                   ///< the name with # for the words of the place
  std::optional<GridPosition> place;  ///< none if there is no such word
};

NamedPlace placeOf(const std::string& name)
{
  const std::vector<std::string> parts = partsOf(name);
  const bool has_side = std::any_of(parts.begin(), parts.end(),
                                    [](const std::string& part) { return placeWord(part) != nullptr; });
  NamedPlace named;
  for (const std::string& part : parts)
  {
    const PlaceWord* const word = placeWord(part);
    if (word == nullptr && (has_side || !isMiddleWord(part)))
    {
      named.rest += part;
      continue;
    }
    GridPosition place = named.place.value_or(GridPosition{0, 0});
    if (word != nullptr)
    {
      place.row = word->row != 0 ? word->row : place.row;
      place.column = word->column != 0 ? word->column : place.column;
    }
    named.place = place;
    appendPlace(named.rest);
  }
  return named;
}

/// The views of one frame.
using PlacedFiles = std::map<GridPosition, fs::path>;

/// Rows and columns that are there, counted from 0.
std::vector<ViewFile> viewsOf(const PlacedFiles& files)
{
  std::set<int> rows;
  std::set<int> columns;
  for (const auto& [place, path] : files)
  {
    rows.insert(place.row);
    columns.insert(place.column);
  }
  const auto rank = [](const std::set<int>& numbers, int number)
  { return static_cast<int>(std::distance(numbers.begin(), numbers.find(number))); };
  std::vector<ViewFile> views;
  for (const auto& [place, path] : files)
  {
    views.push_back({path, {rank(rows, place.row), rank(columns, place.column)}, {}});
  }
  return views;
}

/// Two images, and nothing else that could be a view, whose names differ in one letter: camA and camB.
std::optional<FolderDescription> describeLetters(const FolderListing& listing)
{
  std::vector<fs::path> images;
  std::vector<fs::path> others;
  for (const fs::path& image : listing.images)
  {
    (saysNoView(image.stem().string()) ? others : images).push_back(image);
  }
  if (images.size() != 2)
  {
    return std::nullopt;
  }
  const std::string a = images[0].stem().string();
  const std::string b = images[1].stem().string();
  const auto differ = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (a.size() != b.size() || differ.first == a.end() || !isLetter(*differ.first) ||
      !isLetter(*differ.second) || !std::equal(differ.first + 1, a.end(), differ.second + 1))
  {
    return std::nullopt;
  }
  FolderDescription description;
  description.format = "stereo";
  description.place_claim = PlaceClaim::TwoNumbers;
  description.notes = leftOutNotes(others);
  description.notes.push_back("'" + images[0].filename().string() + "' is taken for the left view, '" +
                              images[1].filename().string() + "' for the right one.");
  description.views = {{images[0], {0, 0}, {}}, {images[1], {0, 1}, {}}};
  return description;
}

}  // namespace

Recognition recognizePlaceWords(const FolderListing& listing, const DatasetOptions& options)
{
  std::map<std::string, PlacedFiles> found;
  std::vector<fs::path> others;
  for (const fs::path& image : listing.images)
  {
    const std::string stem = image.stem().string();
    const NamedPlace named = placeOf(stem);
    if (!named.place || saysNoView(stem) || !found[named.rest].insert({*named.place, image}).second)
    {
      others.push_back(image);
    }
  }
  std::vector<std::string> names;
  for (const auto& [name, files] : found)
  {
    if (files.size() >= 2)
    {
      names.push_back(name);
      continue;
    }
    std::transform(files.begin(), files.end(), std::back_inserter(others),
                   [](const auto& file) { return file.second; });
  }
  const auto rivals = std::count_if(others.begin(), others.end(),
                                    [](const fs::path& path) { return !saysNoView(path.stem().string()); });
  if (names.empty() || rivals > static_cast<std::ptrdiff_t>(names.size()))
  {
    if (auto letters = describeLetters(listing))
    {
      return std::move(*letters);
    }
    return Recognition::no("no names differ in words for places alone, as left and right");
  }
  std::sort(names.begin(), names.end(), sortsBefore);
  FolderDescription description;
  description.place_claim = PlaceClaim::TwoNumbers;
  description.notes = leftOutNotes(others);
  description.views = viewsOf(found[names[chooseFrame(names, options.frame, description)]]);
  description.format = description.views.size() == 2 ? "stereo" : "place words";
  return description;
}

}  // namespace light_field_depth
