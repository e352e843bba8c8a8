#include "io/frame_choice.h"

#include <algorithm>

#include "io/name_groups.h"
#include "io/number_text.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
bool isCalled(const std::string& name, const std::string& wanted)
{
  if (name == wanted)
  {
    return true;
  }
  const auto number = numberFromText<long long>(wanted);
  const NumberedName parts = takeApart(name);
  return number && !parts.numbers.empty() && parts.numbers.back() == *number;
}

}  // namespace

std::size_t frameIndex(const std::vector<std::string>& names, const std::string& wanted)
{
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](const std::string& name) { return isCalled(name, wanted); });
  if (found == names.end())
  {
    throw InputError("There is no frame '" + wanted + "'; the " + std::to_string(names.size()) +
                     " frame(s) go from '" + names.front() + "' to '" + names.back() + "'.");
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t chooseFrame(const std::vector<std::string>& names, const std::optional<std::string>& wanted,
                        FolderDescription& description)
{
  const std::size_t chosen = wanted ? frameIndex(names, *wanted) : 0;
  if (names.size() > 1)
  {
    description.notes.push_back("Frame '" + names[chosen] + "' of " + std::to_string(names.size()) +
                                " is read; --frame chooses another.");
  }
  description.frames = names;
  return chosen;
}

}  // namespace light_field_depth
