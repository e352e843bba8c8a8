// Frames and cameras in the names of one folder: Painter_pr_00012_03, cam03_frame0012.

#include <algorithm>
#include <array>
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

constexpr std::array<std::string_view, 4> FRAME_WORDS = {"frame", "f", "time", "t"};
/// A number with so many digits counts frames where that of the views has at least two digits less.
constexpr std::size_t MIN_FRAME_DIGITS = 4;
constexpr std::size_t MIN_MORE_DIGITS = 2;

/// The word right before each number of a form: "cam", "frame" of "cam#_frame#".
std::vector<std::string> wordsBeforeNumbers(const std::string& form)
{
  std::vector<std::string> words;
  std::string word;
  for (const char letter : form)
  {
    if (letter == '#')
    {
      words.push_back(word);
      word.clear();
    }
    else if (letter >= 'a' && letter <= 'z')
    {
      word += letter;
    }
    else if (!word.empty() && letter != '_' && letter != '-' && letter != ' ')
    {
      word.clear();
    }
  }
  return words;
}

std::size_t leastDigits(const NameGroup& group, std::size_t place)
{
  return std::min_element(group.names.begin(), group.names.end(),
                          [&](const NumberedName& a, const NumberedName& b)
                          { return a.digits[place] < b.digits[place]; })
      ->digits[place];
}

/// Which of the varying numbers counts the frames, if one does.
std::optional<std::size_t> framePlace(const NameGroup& group)
{
  const std::vector<std::size_t> varying = group.varying();
  if (varying.size() < 2)
  {
    return std::nullopt;
  }
  const std::vector<std::string> words = wordsBeforeNumbers(group.form);
  for (const std::size_t place : varying)
  {
    if (std::find(FRAME_WORDS.begin(), FRAME_WORDS.end(), words[place]) != FRAME_WORDS.end())
    {
      return place;
    }
  }
  if (varying.size() == 2)
  {
    const std::size_t first = leastDigits(group, varying.front());
    const std::size_t second = leastDigits(group, varying.back());
    if (std::max(first, second) >= MIN_FRAME_DIGITS &&
        std::max(first, second) >= std::min(first, second) + MIN_MORE_DIGITS)
    {
      return first > second ? varying.front() : varying.back();
    }
  }
  // Frame, row and column: without the first of the three numbers no two of them tell all names apart.
  if (varying.size() == 3 && !rowAndColumnIn(group))
  {
    return varying.front();
  }
  return std::nullopt;
}

}  // namespace

Recognition recognizeFramesInNames(const FolderListing& listing, const DatasetOptions& options)
{
  const auto names = viewNames(listing.folder, listing.images);
  const auto place = names ? framePlace(names->group) : std::nullopt;
  if (!place)
  {
    return Recognition::no("no number in the names counts frames");
  }
  std::map<long long, std::vector<const NumberedName*>> frames;
  for (const NumberedName& name : names->group.names)
  {
    frames[name.numbers[*place]].push_back(&name);
  }
  const std::size_t views = frames.begin()->second.size();
  const bool equal = std::all_of(frames.begin(), frames.end(),
                                 [&](const auto& frame) { return frame.second.size() == views; });
  if (!equal || views < 2)
  {
    return Recognition::no("not all frames have equally many views");
  }
  std::vector<std::string> frame_names;
  for (const auto& [number, of_frame] : frames)
  {
    const std::string text = std::to_string(number);
    const std::size_t digits = of_frame.front()->digits[*place];
    frame_names.push_back((text.size() < digits ? std::string(digits - text.size(), '0') : "") + text);
  }
  FolderDescription choice;
  const std::size_t chosen = chooseFrame(frame_names, options.frame, choice);
  FolderListing of_frame;
  of_frame.folder = listing.folder;
  for (const NumberedName* const name :
       std::next(frames.begin(), static_cast<std::ptrdiff_t>(chosen))->second)
  {
    of_frame.images.push_back(name->path);
  }
  DatasetOptions without_frame = options;
  without_frame.frame.reset();
  for (const auto recognize : {recognizeRowsAndColumns, recognizeFourDigits, recognizeIndex})
  {
    Recognition recognition = recognize(of_frame, without_frame);
    if (recognition)
    {
      (*recognition).frames = choice.frames;
      (*recognition).notes.insert((*recognition).notes.begin(), choice.notes.begin(), choice.notes.end());
      for (const std::string& note : leftOutNotes(names->left_out))
      {
        (*recognition).notes.push_back(note);
      }
      return recognition;
    }
  }
  return Recognition::no("the names of one frame do not say which view is where");
}

}  // namespace light_field_depth
