#include "light_field_depth/io/files.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Removes a file at the end of its life, if it is still there.
class TemporaryFile
{
public:
  explicit TemporaryFile(const fs::path& target)
      : path_(target.parent_path() / ("." + target.stem().string() + ".partial-" + std::to_string(getpid()) +
                                      target.extension().string()))
  {
  }
  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

std::string lastSystemError()
{
  return std::error_code(errno, std::generic_category()).message();
}

}  // namespace

std::string readFile(const fs::path& path)
{
  std::error_code error;
  if (fs::is_directory(path, error))
  {
    throw InputError("'" + path.string() + "' is a folder, but a file is needed.");
  }
  // A pipe may never end, and a device has no end at all.
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
  {
    throw InputError("'" + path.string() + "' is a pipe or a device, but a file is needed.");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file.is_open() || file.bad())
  {
    throw InputError("'" + path.string() + "' cannot be read: " + lastSystemError() + ".");
  }
  return content.str();
}

void writeWhole(const fs::path& path, const std::function<void(const fs::path& temporary)>& write)
{
  const TemporaryFile temporary(path);
  write(temporary.path());
  std::error_code error;
  fs::rename(temporary.path(), path, error);
  if (error)
  {
    throw InputError("'" + path.string() + "' cannot be written: " + error.message() + ".");
  }
}

void writeFile(const fs::path& path, const std::string& content)
{
  writeWhole(path,
             [&](const fs::path& temporary)
             {
               errno = 0;
               std::ofstream file(temporary, std::ios::binary);
               file.write(content.data(), static_cast<std::streamsize>(content.size()));
               file.close();
               if (!file)
               {
                 throw InputError("'" + path.string() + "' cannot be written: " + lastSystemError() +
                                  "; check the folder's permissions and the space on the disk.");
               }
             });
}

void makeFolder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
  {
    throw InputError("The folder '" + folder.string() + "' cannot be created" +
                     (error ? ": " + error.message() : " because a file of that name is there") + ".");
  }
}

}  // namespace light_field_depth
