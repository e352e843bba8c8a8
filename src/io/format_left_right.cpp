// Stereo pairs: left.png and right.png, scene_L.png and scene_R.png, also one pair for each frame.

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>

#include "io/dataset_format.h"
#include "io/frame_choice.h"
#include "io/name_groups.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

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

/// The name without its word for the side, and the side: 0 left, 1 right; no side if there is no such word.
std::pair<std::string, std::optional<int>> sideOf(const std::string& name)
{
  std::string rest;
  std::optional<int> side;
  for (std::string part : partsOf(name))
  {
    std::string word = part;
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const bool is_left = word == "left" || word == "l";
    const bool is_right = word == "right" || word == "r";
    if (is_left || is_right)
    {
      side = is_left ? 0 : 1;
      part = "#";
    }
    rest += part;
  }
  return {rest, side};
}

struct Pair
{
  std::string name;
  fs::path left;
  fs::path right;
};

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

bool sortsPairBefore(const Pair& a, const Pair& b)
{
  return sortsBefore(a.name, b.name);
}

}  // namespace

Recognition recognizeLeftRight(const FolderListing& listing, const DatasetOptions& options)
{
  std::map<std::string, Pair> found;
  std::vector<fs::path> others;
  for (const fs::path& image : listing.images)
  {
    const std::string stem = image.stem().string();
    const auto [name, side] = sideOf(stem);
    if (!side || saysNoView(stem))
    {
      others.push_back(image);
      continue;
    }
    found[name].name = name;
    (*side == 0 ? found[name].left : found[name].right) = image;
  }
  std::vector<Pair> pairs;
  for (const auto& [name, pair] : found)
  {
    if (!pair.left.empty() && !pair.right.empty())
    {
      pairs.push_back(pair);
    }
  }
  const auto rivals = std::count_if(others.begin(), others.end(),
                                    [](const fs::path& path) { return !saysNoView(path.stem().string()); });
  if (pairs.empty() || rivals > static_cast<std::ptrdiff_t>(pairs.size()))
  {
    if (auto letters = describeLetters(listing))
    {
      return std::move(*letters);
    }
    return Recognition::no("no two names differ in left and right alone");
  }
  std::sort(pairs.begin(), pairs.end(), sortsPairBefore);
  std::vector<std::string> names;
  std::transform(pairs.begin(), pairs.end(), std::back_inserter(names),
                 [](const Pair& pair) { return pair.name; });
  FolderDescription description;
  description.format = "stereo";
  description.place_claim = PlaceClaim::TwoNumbers;
  description.notes = leftOutNotes(others);
  const Pair& pair = pairs[chooseFrame(names, options.frame, description)];
  description.views = {{pair.left, {0, 0}, {}}, {pair.right, {0, 1}, {}}};
  return description;
}

}  // namespace light_field_depth
