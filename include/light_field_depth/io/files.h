#ifndef LIGHT_FIELD_DEPTH_IO_FILES_H
#define LIGHT_FIELD_DEPTH_IO_FILES_H

#include <filesystem>
#include <string>

namespace light_field_depth
{
/// The whole content of a file. @throw InputError if it is no regular file, or cannot be read to its end
std::string readFile(const std::filesystem::path& path);

/// Writes a text or a block of bytes as a whole: into a new file of an unpredictable name beside `path`,
/// which is synced to the disk and then renamed, so that under `path` there is the old file or the new one,
/// also after a crash. A symbolic link there is replaced, not followed.
/// @throw InputError if it cannot be written; the old file is still there then, and nothing else
void writeFile(const std::filesystem::path& path, const std::string& content);

/// A new, empty file of a hidden and unpredictable name beside `target`, for writers that want a name and not
/// bytes. It takes the target's place when it is whole, and is removed otherwise.
class PendingFile
{
public:
  /// @throw InputError if it cannot be created
  explicit PendingFile(const std::filesystem::path& target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< what to write
  /// Syncs the file to the disk and renames it. Once, after it was closed. @throw InputError
  void commit();

private:
  std::filesystem::path target_;
  std::filesystem::path path_;
};

/// Creates a folder and its parents if need be. @throw InputError if that is not possible
void makeFolder(const std::filesystem::path& folder);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_FILES_H
