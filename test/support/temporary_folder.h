#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_TEMPORARY_FOLDER_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_TEMPORARY_FOLDER_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace light_field_depth::testing
{
/// A folder of its own for one test, removed with all its files at the end.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "light_field_depth_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
    {
      throw std::runtime_error("no temporary folder");
    }
    path_ = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// A file with the given content. @return its path
  std::filesystem::path write(const std::string& name, const std::string& content) const
  {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

  std::size_t fileCount() const
  {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
    {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }

private:
  std::filesystem::path path_;
};

/// What an InputError says, or "" if `action` throws none.
template <class Error, class Action>
std::string messageOf(const Action& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_TEMPORARY_FOLDER_H
