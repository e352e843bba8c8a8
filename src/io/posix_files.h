#ifndef LIGHT_FIELD_DEPTH_SRC_IO_POSIX_FILES_H
#define LIGHT_FIELD_DEPTH_SRC_IO_POSIX_FILES_H

#include <filesystem>
#include <string>

namespace light_field_depth
{
/// Closes a descriptor at the end of its life.
class Descriptor
{
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool isOpen() const { return number_ >= 0; }
  int number() const { return number_; }

private:
  int number_;
};

/// A hidden name in the folder of `target` that nobody can foresee.
std::filesystem::path hiddenNameBeside(const std::filesystem::path& target);

/// The folder in which a path lies.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// So that names that were made or changed in it outlive a crash; what a file system cannot do is left out.
void syncFolder(const std::filesystem::path& folder);

/// What errno says.
std::string systemError(int number);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_POSIX_FILES_H
