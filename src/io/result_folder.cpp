#include "light_field_depth/io/result_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/posix_files.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* REPORT = "report.json";
constexpr const char* INTERMEDIATE = "intermediate";

/// What the report of an earlier run says that it wrote into the folder, the report itself, and its
/// intermediate results.
std::vector<std::string> resultsIn(const fs::path& folder)
{
  std::error_code error;
  if (!fs::is_regular_file(folder / REPORT, error))
  {
    return {};
  }
  const auto report = nlohmann::json::parse(readFile(folder / REPORT), nullptr, false);
  std::vector<std::string> names = {REPORT, INTERMEDIATE};
  if (report.is_object() && report.contains("files") && report["files"].is_array())
  {
    for (const auto& entry : report["files"])
    {
      const std::string name = entry.is_string() ? entry.get<std::string>() : "";
      // Of a report that somebody else wrote, nothing outside of the folder counts.
      if (!name.empty() && fs::path(name).filename() == name && name != "." && name != "..")
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

std::vector<std::string> namesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    names.push_back(entry->path().filename().string());
  }
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void fail(const fs::path& folder, int error)
{
  throw InputError("The results cannot be put into '" + folder.string() + "': " + systemError(error) +
                   "; check the folder's permissions and the space on the disk.");
}

/// Otherwise nothing can be renamed from beside the folder into it.
bool isOnTheDiskOfItsParent(const fs::path& folder)
{
  struct stat here = {};
  struct stat parent = {};
  const bool is_there = stat(folder.c_str(), &here) == 0;
  return !is_there || (stat(folderOf(folder).c_str(), &parent) == 0 && here.st_dev == parent.st_dev);
}

/// The folder itself, where a symbolic link leads to it.
fs::path resolved(const fs::path& folder)
{
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  const fs::path result = error ? fs::absolute(folder, error) : real;
  // "new/" has no name of its own.
  return result.has_filename() ? result : result.parent_path();
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& target) : target_(resolved(target))
{
  std::error_code error;
  const bool is_new = !fs::exists(fs::symlink_status(target_, error));
  if (is_new)
  {
    makeFolder(folderOf(target_));
  }
  else
  {
    makeFolder(target_);
  }
  constexpr mode_t ANYBODY = 0777;  // less what the user's umask takes away
  for (const fs::path& beside : {target_, target_ / "inside"})
  {
    path_ = hiddenNameBeside(beside);
    is_inside_ = beside != target_;
    if ((is_inside_ || (isOnTheDiskOfItsParent(target_) && canBeReplaced())) &&
        mkdir(path_.c_str(), ANYBODY) == 0)
    {
      return;
    }
  }
  const int reason = errno;
  path_.clear();
  fail(target_, reason);
}

ResultFolder::~ResultFolder()
{
  if (!path_.empty())
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
}

/// Whether the whole folder may be exchanged: nothing else is in it.
bool ResultFolder::canBeReplaced() const
{
  const std::vector<std::string> results = resultsIn(target_);
  const std::vector<std::string> names = namesIn(target_);
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return contains(results, name); });
}

void ResultFolder::commit()
{
  syncFolder(path_);
  if (is_inside_ || !canBeReplaced() || !exchange())
  {
    moveOneByOne();
  }
  syncFolder(folderOf(target_));
}

/// @return false if the file system cannot, and nothing has happened
bool ResultFolder::exchange()
{
  struct stat there = {};
  if (stat(target_.c_str(), &there) != 0)
  {
    // Nothing is there yet; whatever comes between is not overwritten unless it is an empty folder.
    if (std::rename(path_.c_str(), target_.c_str()) != 0)
    {
      fail(target_, errno);
    }
    path_.clear();
    return true;
  }
  chmod(path_.c_str(), there.st_mode & 07777U);
  // The old results are in path_ then, and go with it.
  return renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
}

/// Old results go first, the report comes last: what is in between has none, and is no result.
void ResultFolder::moveOneByOne()
{
  std::error_code error;
  for (const std::string& name : resultsIn(target_))
  {
    fs::remove_all(target_ / name, error);
  }
  std::vector<std::string> names = namesIn(path_);
  std::sort(names.begin(), names.end(),
            [](const std::string& a, const std::string& b)
            { return (a == REPORT) != (b == REPORT) ? b == REPORT : a < b; });
  for (const std::string& name : names)
  {
    const fs::path to = target_ / name;
    if (name == INTERMEDIATE)
    {
      fs::remove_all(to, error);
    }
    if (std::rename((path_ / name).c_str(), to.c_str()) != 0)
    {
      fail(target_, errno);
    }
  }
  syncFolder(target_);
}

}  // namespace light_field_depth
