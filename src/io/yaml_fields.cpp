#include "io/yaml_fields.h"

#include <algorithm>
#include <sstream>

#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
/// A value as it would stand in one line of a file.
std::string flowText(const YAML::Node& value)
{
  YAML::Emitter emitter;
  emitter << YAML::Flow << value;
  return emitter.c_str();
}

}  // namespace

void YamlFields::allowOnly(std::initializer_list<const char*> names) const
{
  std::string known;
  for (const char* const name : names)
  {
    known.append(known.empty() ? "" : ", ").append(name);
  }
  const auto refuse = [&](const std::string& field)
  {
    throw InputError("'" + file_.string() + "' has an unknown field '" + field + "'" +
                     (name_.empty() ? "" : " in " + name_) + "; the known ones are " + known + ".");
  };
  for (const auto& entry : map_)
  {
    const std::string field = entry.first.IsScalar() ? entry.first.Scalar() : flowText(entry.first);
    if (std::find(names.begin(), names.end(), field) == names.end())
    {
      refuse(field);
    }
  }
}

std::optional<double> YamlFields::positive(const std::string& field) const
{
  const std::string wanted = "a positive number";
  const auto value = get<double>(field, wanted);
  if (value && !(std::isfinite(*value) && *value > 0.0))
  {
    fail(field, wanted);
  }
  return value;
}

std::optional<std::pair<double, double>> YamlFields::numberPair(const std::string& field,
                                                                const std::string& wanted) const
{
  const auto values = pair<double>(field, wanted);
  if (values && !(std::isfinite(values->first) && std::isfinite(values->second)))
  {
    fail(field, wanted);
  }
  return values;
}

std::optional<std::pair<int, int>> YamlFields::integerPair(const std::string& field,
                                                           const std::string& wanted) const
{
  return pair<int>(field, wanted);
}

void YamlFields::fail(const std::string& field, const std::string& wanted) const
{
  const std::string where = name_.empty() ? field : name_ + "." + field;
  throw InputError("In '" + file_.string() + "', " + where + " is '" + flowText(map_[field]) +
                   "'; it must be " + wanted + ".");
}

YAML::Node loadYaml(const std::filesystem::path& file)
{
  const std::string text = readFile(file);
  try
  {
    return YAML::Load(text);
  }
  catch (const YAML::Exception& error)
  {
    throw InputError("'" + file.string() + "' is not valid YAML: " + error.msg + " in line " +
                     std::to_string(error.mark.line + 1) + ".");
  }
}

}  // namespace light_field_depth
