#include "io/dataset_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace fs = std::filesystem;

namespace
{
/// What people have light fields in that is not read, and what to do with it.
struct Unreadable
{
  const char* extension;
  const char* remedy;
};

constexpr std::array<Unreadable, 33> UNREADABLE = {{
    {".h5", "is HDF5: write its views as PNG files"},
    {".hdf5", "is HDF5: write its views as PNG files"},
    {".mat", "is MATLAB's: write its views as PNG files"},
    {".npy", "is NumPy's: write its views as PNG files"},
    {".npz", "is NumPy's: write its views as PNG files"},
    {".lfp", "is a plenoptic camera's own file: decode it and export the views or an ESLF image"},
    {".lfr", "is a plenoptic camera's own file: decode it and export the views or an ESLF image"},
    {".lfx", "is a plenoptic camera's own file: decode it and export the views or an ESLF image"},
    {".raw", "is raw: develop it and export the views"},
    {".dng", "is raw: develop it and export the views"},
    {".cr2", "is raw: develop it and export the views"},
    {".nef", "is raw: develop it and export the views"},
    {".cr3", "is raw: develop it and export the views"},
    {".arw", "is raw: develop it and export the views"},
    {".orf", "is raw: develop it and export the views"},
    {".raf", "is raw: develop it and export the views"},
    {".rw2", "is raw: develop it and export the views"},
    {".heic", "is HEIC: convert it to PNG or JPEG"},
    {".heif", "is HEIF: convert it to PNG or JPEG"},
    {".avif", "is AVIF: convert it to PNG or JPEG"},
    {".jxl", "is JPEG XL: convert it to PNG or JPEG"},
    {".svg", "is a drawing: convert it to PNG"},
    {".psd", "is Photoshop's: export it as PNG"},
    {".mp4", "is a video: extract its frames as PNG files"},
    {".avi", "is a video: extract its frames as PNG files"},
    {".mov", "is a video: extract its frames as PNG files"},
    {".mkv", "is a video: extract its frames as PNG files"},
    {".webm", "is a video: extract its frames as PNG files"},
    {".gif", "is a GIF: convert it to PNG"},
    {".jp2", "is JPEG 2000: convert it to PNG"},
    {".hdr", "is Radiance HDR: convert it to EXR or PNG"},
    {".zip", "is an archive: unpack it"},
    {".bag", "is a ROS bag: play it to the node"},
}};

/// Names of images that are no files: links to nothing, as copies without what they point to leave them.
std::vector<fs::path> brokenImages(const FolderListing& listing)
{
  std::vector<fs::path> broken;
  std::copy_if(listing.others.begin(), listing.others.end(), std::back_inserter(broken), isImageFile);
  return broken;
}

std::string brokenText(const std::vector<fs::path>& broken)
{
  const std::string name = "'" + broken.front().filename().string() + "'";
  return broken.size() == 1
             ? name + " is a link to nothing, or no file"
             : name + " and " + std::to_string(broken.size() - 1) + " more are links to nothing, or no files";
}

/// Which file is there that is almost what is wanted; empty if there is none.
std::string unreadableText(const std::vector<fs::path>& files)
{
  for (const fs::path& file : files)
  {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const auto* const known =
        std::find_if(UNREADABLE.begin(), UNREADABLE.end(),
                     [&](const Unreadable& kind) { return extension == kind.extension; });
    if (known != UNREADABLE.end())
    {
      return "; '" + file.filename().string() + "' " + known->remedy;
    }
  }
  return "";
}

}  // namespace

const std::vector<DatasetFormat>& datasetFormats()
{
  static const std::vector<DatasetFormat> formats = {
      {"light_field.yaml", recognizeYaml},
      {"lightfield.json", recognizeIdLab},
      {"transforms.json", recognizeTransforms},
      {"COLMAP", recognizeColmap},
      {"KITTI's image_2 and image_3", recognizeKitti},
      {"a folder for each camera or frame", recognizeFolders},
      {"one image with all views", recognizeImage},
      {"Middlebury's calib.txt", recognizeMiddlebury},
      {"words for places, as left and right", recognizePlaceWords},
      {"HCI's input_Cam000", recognizeHci},
      {"positions as in out_00_00_1.5_2.5", recognizePositions},
      {"frames and views as in 00000_00", recognizeFramesInNames},
      {"rows and columns as in 00_00", recognizeRowsAndColumns},
      {"rows and columns as in 0000", recognizeFourDigits},
      {"an index as in view000", recognizeIndex},
  };
  return formats;
}

FolderDescription describeFolder(const fs::path& folder, const DatasetOptions& options)
{
  const FolderListing listing = listFolder(folder);
  const std::vector<fs::path> broken = brokenImages(listing);
  std::string tried;
  for (const DatasetFormat& format : datasetFormats())
  {
    Recognition recognition = format.recognize(listing, options);
    if (recognition)
    {
      if (!broken.empty())
      {
        (*recognition).warnings.push_back(brokenText(broken) + "; copy what is missing if it is a view.");
      }
      return std::move(*recognition);
    }
    tried.append(tried.empty() ? "" : "; ")
        .append(format.name)
        .append(" (")
        .append(recognition.reason())
        .append(")");
  }
  if (listing.images.empty() && listing.folders.empty())
  {
    throw InputError("The folder '" + folder.string() + "' has no images in it (" + imageFormatsText() + ")" +
                     (broken.empty() ? unreadableText(listing.others) : "; " + brokenText(broken)) +
                     "; name the folder that holds the views.");
  }
  const std::string first =
      listing.images.empty() ? "" : " (the first is '" + listing.images.front().filename().string() + "')";
  throw InputError("None of the " + std::to_string(listing.images.size()) + " image(s) in '" +
                   folder.string() + "'" + first + " is named like a view. Tried: " + tried +
                   ". Rename the views or describe them in a light_field.yaml.");
}

}  // namespace light_field_depth
