#ifndef LIGHT_FIELD_DEPTH_CORE_ENUM_NAMES_H
#define LIGHT_FIELD_DEPTH_CORE_ENUM_NAMES_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
/// The values of an enumeration with the names by which people write them.
template <typename Value, std::size_t COUNT>
using EnumNames = std::array<std::pair<Value, const char*>, COUNT>;

/// @param value one that has a name
template <typename Value, std::size_t COUNT>
std::string enumName(const EnumNames<Value, COUNT>& names, Value value)
{
  for (const auto& [known, name] : names)
  {
    if (known == value)
    {
      return name;
    }
  }
  return {};
}

/// Nothing if no value has this name.
template <typename Value, std::size_t COUNT>
std::optional<Value> findEnumValue(const EnumNames<Value, COUNT>& names, const std::string& name)
{
  for (const auto& [value, known] : names)
  {
    if (known == name)
    {
      return value;
    }
  }
  return std::nullopt;
}

/// @param what the enumeration is called in the sentence of the error
/// @throw InputError that lists the names
template <typename Value, std::size_t COUNT>
Value enumValue(const EnumNames<Value, COUNT>& names, const std::string& name, const std::string& what)
{
  if (const std::optional<Value> value = findEnumValue(names, name))
  {
    return *value;
  }
  std::string choices;
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    choices += (i == 0 ? "" : i + 1 == COUNT ? " or " : ", ") + std::string(names[i].second);
  }
  throw InputError("There is no " + what + " '" + name + "'; choose " + choices + ".");
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_ENUM_NAMES_H
