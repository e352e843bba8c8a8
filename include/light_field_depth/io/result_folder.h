#ifndef LIGHT_FIELD_DEPTH_IO_RESULT_FOLDER_H
#define LIGHT_FIELD_DEPTH_IO_RESULT_FOLDER_H

#include <filesystem>

namespace light_field_depth
{
/// All results of a run or none: they are written into a new hidden folder, which takes the place of the
/// target when they are complete. Where the target holds nothing but results of an earlier run (as its
/// report.json lists them), both folders are exchanged in one step. In a folder with other files, those stay,
/// earlier results are removed, and the new ones are renamed one by one, the report last. Not thread-safe.
class ResultFolder
{
public:
  /// Creates the hidden folder beside the target, or in it where that is not possible.
  /// @throw InputError if there can be no such folder
  explicit ResultFolder(const std::filesystem::path& target);
  /// Removes what was not committed.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where the results are to be written.
  const std::filesystem::path& path() const { return path_; }

  /// Puts the results into the target. Once. @throw InputError
  void commit();

private:
  bool canBeReplaced() const;
  bool exchange();
  void moveOneByOne();

  std::filesystem::path target_;
  std::filesystem::path path_;
  bool is_inside_ = false;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_RESULT_FOLDER_H
