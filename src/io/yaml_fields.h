#ifndef LIGHT_FIELD_DEPTH_SRC_IO_YAML_FIELDS_H
#define LIGHT_FIELD_DEPTH_SRC_IO_YAML_FIELDS_H

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
/// The fields of one map of a YAML file; every complaint names the file and the field.
class YamlFields
{
public:
  /// @param name of the map for messages; empty for the top of the file
  YamlFields(std::filesystem::path file, std::string name, const YAML::Node& map)
      : file_(std::move(file)), name_(std::move(name)), map_(map)
  {
    if (!map_.IsMap())
    {
      throw InputError((name_.empty() ? "The top level" : name_) + " of '" + file_.string() +
                       "' is not a map of 'field: value' pairs.");
    }
  }

  /// @throw InputError for a field that is none of these
  void allowOnly(std::initializer_list<const char*> names) const;

  bool has(const std::string& field) const { return static_cast<bool>(map_[field]); }
  YAML::Node node(const std::string& field) const { return map_[field]; }

  /// Empty if the field is absent. @throw InputError if it is of another type.
  template <class Value>
  std::optional<Value> get(const std::string& field, const std::string& wanted) const
  {
    if (!has(field))
    {
      return std::nullopt;
    }
    return as<Value>(map_[field], field, wanted);
  }

  std::optional<double> positive(const std::string& field) const;
  /// A list of two numbers.
  std::optional<std::pair<double, double>> numberPair(const std::string& field,
                                                      const std::string& wanted) const;
  std::optional<std::pair<int, int>> integerPair(const std::string& field, const std::string& wanted) const;

  /// "In 'light_field.yaml', focal_length_px is '...'; it must be WANTED."
  [[noreturn]] void fail(const std::string& field, const std::string& wanted) const;

private:
  template <class Value>
  Value as(const YAML::Node& value, const std::string& field, const std::string& wanted) const
  {
    try
    {
      return value.as<Value>();
    }
    catch (const YAML::Exception&)
    {
      fail(field, wanted);
    }
  }

  template <class Value>
  std::optional<std::pair<Value, Value>> pair(const std::string& field, const std::string& wanted) const
  {
    if (!has(field))
    {
      return std::nullopt;
    }
    const YAML::Node list = map_[field];
    if (!list.IsSequence() || list.size() != 2)
    {
      fail(field, wanted);
    }
    return std::make_pair(as<Value>(list[0], field, wanted), as<Value>(list[1], field, wanted));
  }

  std::filesystem::path file_;
  std::string name_;
  YAML::Node map_;
};

/// @throw InputError that names the line where a YAML file is broken
YAML::Node loadYaml(const std::filesystem::path& file);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_YAML_FIELDS_H
