#ifndef LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_LISTING_H
#define LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_LISTING_H

#include <filesystem>
#include <string>
#include <vector>

namespace light_field_depth
{
/// What lies in a folder, read once. Hidden entries are left out; numbers in names sort as numbers.
struct FolderListing
{
  std::filesystem::path folder;
  std::vector<std::filesystem::path> images;  ///< regular files of a known image format
  std::vector<std::filesystem::path> folders;
  std::vector<std::filesystem::path> others = {};  ///< all else
};

/// @throw InputError if the folder cannot be read
FolderListing listFolder(const std::filesystem::path& folder);

/// Whether a regular file is there; links are followed. False also where the system refuses to tell.
bool isFile(const std::filesystem::path& path);

/// Whether a name comes before another one when runs of digits are compared as numbers: view2 before view10.
bool sortsBefore(const std::string& a, const std::string& b);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_FOLDER_LISTING_H
