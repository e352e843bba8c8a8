#include "io/dataset_format.h"

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace fs = std::filesystem;

const std::vector<DatasetFormat>& datasetFormats()
{
  static const std::vector<DatasetFormat> formats = {
      {"light_field.yaml", recognizeYaml},
      {"lightfield.json", recognizeIdLab},
      {"transforms.json", recognizeTransforms},
      {"COLMAP", recognizeColmap},
      {"a folder for each camera or frame", recognizeFolders},
      {"one image with all views", recognizeImage},
      {"Middlebury's calib.txt", recognizeMiddlebury},
      {"left and right", recognizeLeftRight},
      {"HCI's input_Cam000", recognizeHci},
      {"positions as in out_00_00_1.5_2.5", recognizePositions},
      {"rows and columns as in 00_00", recognizeRowsAndColumns},
      {"rows and columns as in 0000", recognizeFourDigits},
      {"an index as in view000", recognizeIndex},
  };
  return formats;
}

FolderDescription describeFolder(const fs::path& folder, const DatasetOptions& options)
{
  const FolderListing listing = listFolder(folder);
  std::string tried;
  for (const DatasetFormat& format : datasetFormats())
  {
    Recognition recognition = format.recognize(listing, options);
    if (recognition)
    {
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
    throw InputError("The folder '" + folder.string() + "' has no images in it (" + imageFormatsText() +
                     "); name the folder that holds the views.");
  }
  const std::string first =
      listing.images.empty() ? "" : " (the first is '" + listing.images.front().filename().string() + "')";
  throw InputError("None of the " + std::to_string(listing.images.size()) + " image(s) in '" +
                   folder.string() + "'" + first + " is named like a view. Tried: " + tried +
                   ". Rename the views or describe them in a light_field.yaml.");
}

}  // namespace light_field_depth
