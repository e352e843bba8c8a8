#include "io/posix_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <random>
#include <system_error>

namespace light_field_depth
{
Descriptor::~Descriptor()
{
  if (isOpen())
  {
    close(number_);
  }
}

std::filesystem::path hiddenNameBeside(const std::filesystem::path& target)
{
  constexpr std::size_t LETTERS = 16;                                      // that nobody guesses
  static const std::string ALPHABET = "abcdefghijklmnopqrstuvwxyz012345";  // five bits each
  std::random_device random;
  std::string name = ".light_field_depth.partial-";
  for (std::size_t i = 0; i < LETTERS; ++i)
  {
    name += ALPHABET[random() % ALPHABET.size()];
  }
  return folderOf(target) / name;
}

std::filesystem::path folderOf(const std::filesystem::path& path)
{
  const std::filesystem::path parent = path.parent_path();
  return parent.empty() ? "." : parent;
}

void syncFolder(const std::filesystem::path& folder)
{
  const Descriptor descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.isOpen())
  {
    fsync(descriptor.number());
  }
}

std::string systemError(int number)
{
  return std::error_code(number, std::generic_category()).message();
}

}  // namespace light_field_depth
