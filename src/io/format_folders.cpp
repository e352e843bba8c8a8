// A folder for each camera (cam_00/image_000.jpg, left/0001.png) or for each frame (frame_000/00_00.png).

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <string_view>

#include "io/dataset_format.h"
#include "io/frame_choice.h"
#include "io/name_groups.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/index_grid.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> FRAME_WORDS = {"frame", "frames", "f", "time", "t", "step"};

bool isFrameName(const fs::path& folder)
{
  std::string word;
  for (const char letter : folder.filename().string() + " ")
  {
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0)
    {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      continue;
    }
    if (std::find(FRAME_WORDS.begin(), FRAME_WORDS.end(), word) != FRAME_WORDS.end())
    {
      return true;
    }
    word.clear();
  }
  return false;
}

/// The views in a folder, or in the only folder with images inside of it (cam0/data).
std::vector<fs::path> viewImages(const fs::path& folder)
{
  FolderListing listing = listFolder(folder);
  if (listing.images.empty() && listing.folders.size() == 1)
  {
    listing = listFolder(listing.folders.front());
  }
  std::vector<fs::path> images = listing.images;
  const auto says_no = [](const fs::path& path) { return saysNoView(path.stem().string()); };
  if (!std::all_of(images.begin(), images.end(), says_no))
  {
    images.erase(std::remove_if(images.begin(), images.end(), says_no), images.end());
  }
  return images;
}

/// The folders as if they were files, so that their names are understood like those of views.
FolderListing asViews(const FolderListing& listing, const std::vector<fs::path>& folders)
{
  FolderListing views;
  views.folder = listing.folder;
  views.images = folders;
  return views;
}

std::optional<FolderDescription> placeFolders(const FolderListing& views, const DatasetOptions& options)
{
  DatasetOptions without_frame = options;
  without_frame.frame.reset();
  for (const auto recognize :
       {recognizePlaceWords, recognizeHci, recognizeRowsAndColumns, recognizeFourDigits, recognizeIndex})
  {
    Recognition recognition = recognize(views, without_frame);
    if (recognition)
    {
      return std::move(*recognition);
    }
  }
  return std::nullopt;
}

std::vector<std::string> stemsOf(const std::vector<fs::path>& images)
{
  std::vector<std::string> stems;
  std::transform(images.begin(), images.end(), std::back_inserter(stems),
                 [](const fs::path& path) { return path.stem().string(); });
  return stems;
}

/// Whether a folder is a row (or column) whose images are its views: row_0/col_1, or 00/01 with as many in
/// each as there are folders.
bool areRowsOfViews(const std::vector<fs::path>& folders)
{
  const auto form_of = [](const fs::path& path) { return takeApart(path.filename()).form; };
  std::vector<std::string> first_stems;
  std::string image_form;
  for (const fs::path& folder : folders)
  {
    const std::vector<fs::path> images = viewImages(folder);
    std::vector<std::string> stems = stemsOf(images);
    if (first_stems.empty())
    {
      first_stems = stems;
      image_form = images.empty() ? "" : takeApart(images.front()).form;
    }
    if (stems != first_stems ||
        takeApart(folder.filename()).form != takeApart(folders.front().filename()).form)
    {
      return false;
    }
  }
  const auto begins_with = [](const std::string& text, const char* word) { return text.rfind(word, 0) == 0; };
  const std::string folder_form = form_of(folders.front());
  const bool rows = begins_with(folder_form, "row") || begins_with(folder_form, "col") ||
                    folder_form == "y#" || folder_form == "v#" || folder_form == "x#" || folder_form == "u#";
  const bool views = begins_with(image_form, "row") || begins_with(image_form, "col") || image_form == "x#" ||
                     image_form == "u#" || image_form == "y#" || image_form == "v#";
  const bool bare_square = folder_form == "#" && image_form == "#" && first_stems.size() == folders.size();
  return first_stems.size() >= 2 && ((rows && views) || bare_square);
}

std::optional<FolderDescription> describeRowsOfViews(const std::vector<fs::path>& folders)
{
  FolderDescription description;
  description.format = "grid of folders";
  description.place_claim = PlaceClaim::TwoNumbers;
  for (const fs::path& folder : folders)
  {
    const NumberedName row = takeApart(folder.filename());
    for (const fs::path& image : viewImages(folder))
    {
      const NumberedName column = takeApart(image);
      if (row.numbers.size() != 1 || column.numbers.size() != 1)
      {
        return std::nullopt;
      }
      const auto to_int = [](long long number)
      { return static_cast<int>(std::clamp<long long>(number, -MAX_NUMBER, MAX_NUMBER)); };
      description.views.push_back({image, {to_int(row.numbers.front()), to_int(column.numbers.front())}, {}});
    }
  }
  return description;
}

/// The image of the same frame in another camera's folder: of the same name, or else of the same place.
fs::path sameFrame(const std::vector<fs::path>& images, const std::vector<std::string>& names,
                   std::size_t frame, const fs::path& folder)
{
  const std::vector<std::string> stems = stemsOf(images);
  const auto same_name = std::find(stems.begin(), stems.end(), names[frame]);
  if (same_name != stems.end())
  {
    return images[static_cast<std::size_t>(same_name - stems.begin())];
  }
  if (images.size() != names.size())
  {
    throw InputError("The camera folder '" + folder.string() + "' has " + std::to_string(images.size()) +
                     " image(s) and none is called '" + names[frame] + "', but the first camera has " +
                     std::to_string(names.size()) + "; give all cameras the same frames.");
  }
  return images[frame];
}

FolderDescription describeCameras(FolderDescription description, const DatasetOptions& options)
{
  std::vector<std::string> names = stemsOf(viewImages(description.views.front().path));
  const std::size_t frame = chooseFrame(names, options.frame, description);
  for (ViewFile& view : description.views)
  {
    view.path = sameFrame(viewImages(view.path), names, frame, view.path);
  }
  description.format += " of folders";
  return description;
}

FolderDescription describeFrames(const std::vector<fs::path>& folders, const DatasetOptions& options)
{
  std::vector<std::string> names;
  std::transform(folders.begin(), folders.end(), std::back_inserter(names),
                 [](const fs::path& path) { return path.filename().string(); });
  FolderDescription choice;
  const std::size_t frame = chooseFrame(names, options.frame, choice);
  DatasetOptions without_frame = options;
  without_frame.frame.reset();
  FolderDescription description = describeFolder(folders[frame], without_frame);
  description.frames = choice.frames;
  description.notes.insert(description.notes.begin(), choice.notes.begin(), choice.notes.end());
  return description;
}

/// Whether the images of a folder, counted by one number, lie in the rows of a grid: no video looks like
/// that.
bool showsGrid(const FolderListing& listing, const DatasetOptions& options)
{
  constexpr std::size_t MIN_VIEWS_OF_GRID = 4;  // 2 x 2
  Recognition recognition = recognizeIndex(listing, options);
  if (!recognition || (*recognition).views.size() < MIN_VIEWS_OF_GRID)
  {
    return false;
  }
  const auto& views = (*recognition).views;
  const int count = static_cast<int>(views.size());
  std::vector<cv::Mat> thumbnails;
  for (int i = 0; i < thumbnailsForRunLength(count); ++i)
  {
    thumbnails.push_back(
        thumbnailOf(readImage(views[static_cast<std::size_t>(i)].path, nullptr, options.max_megapixels)));
    if (thumbnails.back().size() != thumbnails.front().size())
    {
      return false;
    }
  }
  const RunLength run = findRunLength(thumbnails, count);
  return run.length > 0 && run.length < count;
}

bool isCameraName(const fs::path& folder)
{
  const std::string form = takeApart(folder.filename()).form;
  return form.find("cam") != std::string::npos || form.find("view") != std::string::npos;
}

/// Whether the images of a folder are a light field by themselves.
bool holdsLightField(const FolderListing& listing, const DatasetOptions& options)
{
  const auto claims = [&](auto recognize)
  {
    Recognition recognition = recognize(listing, options);
    return recognition && (*recognition).views.size() >= 2;
  };
  return isFile(listing.folder / "light_field.yaml") || claims(recognizeHci) || claims(recognizePositions) ||
         claims(recognizeRowsAndColumns) || claims(recognizeFourDigits) ||
         (!isCameraName(listing.folder) && showsGrid(listing, options));
}

}  // namespace

Recognition recognizeFolders(const FolderListing& listing, const DatasetOptions& options)
{
  const auto says_no = [](const fs::path& path) { return saysNoView(path.stem().string()); };
  const auto views = listing.images.size() - static_cast<std::size_t>(std::count_if(
                                                 listing.images.begin(), listing.images.end(), says_no));
  if (views >= 2 || (views == 1 && listing.folders.size() < 2))
  {
    return Recognition::no("the images lie in the folder itself");
  }
  std::vector<fs::path> folders;
  for (const fs::path& folder : listing.folders)
  {
    if (!saysNoView(folder.filename().string()) && !viewImages(folder).empty())
    {
      folders.push_back(folder);
    }
  }
  if (folders.empty() && listing.folders.size() == 1)
  {
    folders = listing.folders;  // a folder in a folder in a folder
  }
  if (folders.empty())
  {
    return Recognition::no("no folder in it has images");
  }
  if (folders.size() == 1)
  {
    FolderDescription description = describeFolder(folders.front(), options);
    description.notes.insert(description.notes.begin(),
                             "The views are those in '" + folders.front().filename().string() + "'.");
    return description;
  }
  if (areRowsOfViews(folders))
  {
    if (auto rows = describeRowsOfViews(folders))
    {
      return std::move(*rows);
    }
  }
  if (isFrameName(folders.front()) || holdsLightField(listFolder(folders.front()), options))
  {
    return describeFrames(folders, options);
  }
  auto cameras = placeFolders(asViews(listing, folders), options);
  if (!cameras)
  {
    return Recognition::no("the names of the folders do not say which camera is where");
  }
  return describeCameras(std::move(*cameras), options);
}

}  // namespace light_field_depth
