#include "light_field_depth/io/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/posix_files.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr mode_t ANYBODY = 0666;  // less what the user's umask takes away

[[noreturn]] void failToRead(const fs::path& path, int error)
{
  throw InputError("'" + path.string() + "' cannot be read: " + systemError(error) + ".");
}

[[noreturn]] void failToWrite(const fs::path& path, int error)
{
  throw InputError("'" + path.string() + "' cannot be written: " + systemError(error) +
                   "; check the folder's permissions and the space on the disk.");
}

/// Created anew, never one that is there or that a link leads to.
void createFile(const fs::path& path, const fs::path& target)
{
  const Descriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, ANYBODY));
  if (!file.isOpen())
  {
    failToWrite(target, errno);
  }
}

void fill(const Descriptor& file, const std::string& content, const fs::path& target)
{
  std::size_t done = 0;
  while (done < content.size())
  {
    const ssize_t count = write(file.number(), content.data() + done, content.size() - done);
    if (count < 0 && errno != EINTR)
    {
      failToWrite(target, errno);
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

}  // namespace

std::string readFile(const fs::path& path)
{
  // A pipe may never end or have a writer, and a device has no end at all: neither is waited for.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status = {};
  if (!file.isOpen() || fstat(file.number(), &status) != 0)
  {
    failToRead(path, errno);
  }
  if (S_ISDIR(status.st_mode))
  {
    throw InputError("'" + path.string() + "' is a folder, but a file is needed.");
  }
  if (!S_ISREG(status.st_mode))
  {
    throw InputError("'" + path.string() + "' is a pipe or a device, but a file is needed.");
  }
  std::string content;
  std::size_t done = 0;
  for (;;)
  {
    // One byte more than the file is said to have tells its end without another round.
    constexpr std::size_t LEAST_BLOCK = 4096;
    const auto said = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
    content.resize(std::max(said + 1, done + LEAST_BLOCK));
    const ssize_t count = read(file.number(), content.data() + done, content.size() - done);
    if (count < 0 && errno != EINTR)
    {
      failToRead(path, errno);
    }
    if (count == 0)
    {
      content.resize(done);
      return content;
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

PendingFile::PendingFile(const fs::path& target) : target_(target), path_(hiddenNameBeside(target))
{
  std::error_code error;
  const fs::file_status there = fs::symlink_status(target, error);
  if (fs::exists(there) && !fs::is_regular_file(there) && !fs::is_symlink(there))
  {
    throw InputError("'" + target.string() +
                     "' cannot be written: a folder, pipe or device of that name is there; choose another.");
  }
  createFile(path_, target_);
}

PendingFile::~PendingFile()
{
  if (!path_.empty())
  {
    unlink(path_.c_str());
  }
}

void PendingFile::commit()
{
  const Descriptor file(open(path_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
  // Full disks may show only here. Some file systems have no such call.
  if (!file.isOpen() || (fsync(file.number()) != 0 && errno != EINVAL && errno != ENOSYS) ||
      std::rename(path_.c_str(), target_.c_str()) != 0)
  {
    failToWrite(target_, errno);
  }
  path_.clear();
  syncFolder(folderOf(target_));
}

void writeFile(const fs::path& path, const std::string& content)
{
  PendingFile pending(path);
  {
    const Descriptor file(open(pending.path().c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
    if (!file.isOpen())
    {
      failToWrite(path, errno);
    }
    fill(file, content, path);
  }
  pending.commit();
}

void makeFolder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  std::error_code absent;
  if (!fs::is_directory(folder, absent))
  {
    throw InputError("The folder '" + folder.string() + "' cannot be created" +
                     (error ? ": " + error.message() : " because a file of that name is there") + ".");
  }
}

}  // namespace light_field_depth
