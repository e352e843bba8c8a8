#ifndef LIGHT_FIELD_DEPTH_SRC_IO_NAME_GROUPS_H
#define LIGHT_FIELD_DEPTH_SRC_IO_NAME_GROUPS_H

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/folder_listing.h"

namespace light_field_depth
{
/// A name without its ending, taken apart into numbers and the text around them.
struct NumberedName
{
  std::filesystem::path path;
  std::string form;                 ///< the name in lower case with '#' for each number: "view_#_#"
  std::vector<long long> numbers;   ///< a '-' before a number is a sign unless a letter or digit precedes it
  std::vector<std::size_t> digits;  ///< of each number as it was written
};

NumberedName takeApart(const std::filesystem::path& path);

/// Names of one form.
struct NameGroup
{
  std::string form;
  std::vector<NumberedName> names;

  /// The places in NumberedName::numbers whose number is not the same in all names.
  std::vector<std::size_t> varying() const;
};

/// Two places in the names' numbers that are row and column: their pairs are unique and fill a grid.
std::optional<std::pair<std::size_t, std::size_t>> rowAndColumnIn(const NameGroup& group);

/// The views among the images or folders that were listed.
struct ViewNames
{
  NameGroup group;
  std::vector<std::filesystem::path> left_out;  ///< thumbnails, masks, truth and what else is beside them
};

/// The largest group of numbered names that are not by their words masks, truth, thumbnails and the like.
/// Empty if no name has a number. @throw InputError if two datasets are mixed
std::optional<ViewNames> viewNames(const std::filesystem::path& folder,
                                   const std::vector<std::filesystem::path>& paths);

/// Whether a word of the name says that it is no view: mask, depth, truth, thumbnail, ...
bool saysNoView(const std::string& name);

/// A sentence that says what was left out; empty if nothing was.
std::vector<std::string> leftOutNotes(const std::vector<std::filesystem::path>& left_out);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_NAME_GROUPS_H
