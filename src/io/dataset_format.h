#ifndef LIGHT_FIELD_DEPTH_SRC_IO_DATASET_FORMAT_H
#define LIGHT_FIELD_DEPTH_SRC_IO_DATASET_FORMAT_H

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/folder_description.h"
#include "io/folder_listing.h"

namespace light_field_depth
{
/// What a format makes of a folder: a description, or the reason why it is not of this format.
class Recognition
{
public:
  Recognition(FolderDescription description) : description_(std::move(description)) {}

  /// @param reason follows the name of the format: "no parameters.cfg"
  static Recognition no(std::string reason)
  {
    Recognition recognition{FolderDescription()};
    recognition.description_.reset();
    recognition.reason_ = std::move(reason);
    return recognition;
  }

  explicit operator bool() const { return description_.has_value(); }
  FolderDescription& operator*() { return *description_; }
  const std::string& reason() const { return reason_; }

private:
  std::optional<FolderDescription> description_;
  std::string reason_;
};

/// A way in which light fields lie in folders.
struct DatasetFormat
{
  const char* name;
  /// @throw InputError if the folder is of this format but something in it is wrong
  Recognition (*recognize)(const FolderListing& listing, const DatasetOptions& options);
};

/// In the order in which they are tried: what states the most comes first.
const std::vector<DatasetFormat>& datasetFormats();

/// Tries all formats. @throw InputError that lists them with their reasons if none matches
FolderDescription describeFolder(const std::filesystem::path& folder, const DatasetOptions& options);

/// One file with all views in it. @throw InputError
FolderDescription describeImage(const std::filesystem::path& file, const DatasetOptions& options);

Recognition recognizeYaml(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeIdLab(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeTransforms(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeColmap(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeFramesInNames(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeKitti(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeMiddlebury(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizePlaceWords(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeHci(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizePositions(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeRowsAndColumns(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeFourDigits(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeIndex(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeImage(const FolderListing& listing, const DatasetOptions& options);
Recognition recognizeFolders(const FolderListing& listing, const DatasetOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_DATASET_FORMAT_H
