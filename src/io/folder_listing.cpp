#include "io/folder_listing.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

bool isDigit(char letter)
{
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

/// The run of digits at a place without its leading zeros; moves the place behind it.
std::string takeNumber(const std::string& text, std::size_t& place)
{
  const std::size_t begin = place;
  while (place < text.size() && isDigit(text[place]))
  {
    ++place;
  }
  const std::string digits = text.substr(begin, place - begin);
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

void sortByName(std::vector<fs::path>& paths)
{
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b)
            { return sortsBefore(a.filename().string(), b.filename().string()); });
}

}  // namespace

bool sortsBefore(const std::string& a, const std::string& b)
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (isDigit(a[i]) && isDigit(b[j]))
    {
      const std::string left = takeNumber(a, i);
      const std::string right = takeNumber(b, j);
      if (left != right)
      {
        return left.size() != right.size() ? left.size() < right.size() : left < right;
      }
      continue;
    }
    if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    ++i;
    ++j;
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

bool isFile(const fs::path& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

FolderListing listFolder(const fs::path& folder)
{
  FolderListing listing;
  listing.folder = folder;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    std::error_code unreadable;
    if (entry->path().filename().string().front() == '.')
    {
      continue;
    }
    if (isImageFile(entry->path()) && entry->is_regular_file(unreadable))
    {
      listing.images.push_back(entry->path());
    }
    else if (entry->is_directory(unreadable))
    {
      listing.folders.push_back(entry->path());
    }
    else
    {
      listing.others.push_back(entry->path());
    }
  }
  if (error)
  {
    throw InputError("The folder '" + folder.string() + "' cannot be read: " + error.message() + ".");
  }
  sortByName(listing.images);
  sortByName(listing.folders);
  sortByName(listing.others);
  return listing;
}

}  // namespace light_field_depth
