#include "light_field_depth/io/pipeline_options_io.h"

#include <cmath>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <type_traits>

#include "io/number_text.h"
#include "io/yaml_fields.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/options_visitor.h"

namespace light_field_depth
{
namespace
{
/// The shortest decimal that reads back as the same number.
template <class Number>
std::string shortestText(Number number)
{
  if constexpr (std::is_integral_v<Number>)
  {
    return std::to_string(number);
  }
  std::string text;
  for (int digits = std::numeric_limits<Number>::digits10;
       digits <= std::numeric_limits<Number>::max_digits10; ++digits)
  {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << number;
    text = stream.str();
    if (numberFromText<Number>(text) == number)
    {
      break;
    }
  }
  return text;
}

template <class Field>
OptionValue toOptionValue(const Field& field)
{
  if constexpr (std::is_same_v<Field, bool> || std::is_same_v<Field, int> || std::is_same_v<Field, double> ||
                std::is_same_v<Field, std::string>)
  {
    return field;
  }
  else if constexpr (std::is_same_v<Field, float>)
  {
    return numberFromText<double>(shortestText(field)).value_or(field);
  }
  else
  {
    return toString(field);
  }
}

[[noreturn]] void failValue(const std::string& name, const std::string& text, const std::string& wanted)
{
  throw InputError("The setting " + name + " cannot be '" + text + "'; it must be " + wanted + ".");
}

bool parseBool(const std::string& name, const std::string& text)
{
  if (text == "true" || text == "yes" || text == "on" || text == "1")
  {
    return true;
  }
  if (text == "false" || text == "no" || text == "off" || text == "0")
  {
    return false;
  }
  failValue(name, text, "true or false");
}

template <class Field>
void parseInto(const std::string& name, const std::string& text, Field& field)
{
  if constexpr (std::is_same_v<Field, bool>)
  {
    field = parseBool(name, text);
  }
  else if constexpr (std::is_same_v<Field, std::string>)
  {
    field = text;
  }
  else if constexpr (std::is_arithmetic_v<Field>)
  {
    const auto number = numberFromText<Field>(text);
    if (!number)
    {
      failValue(name, text, std::is_integral_v<Field> ? "a whole number" : "a number");
    }
    field = *number;
  }
  else
  {
    fromString(text, field);
  }
}

/// A value of an options file as setOption() takes it: a scalar, or a list of scalars with commas.
std::string settingText(const YamlFields& fields, const std::string& name)
{
  if (!fields.has(name))
  {
    return "";
  }
  const YAML::Node value = fields.node(name);
  if (value.IsScalar())
  {
    return value.Scalar();
  }
  std::string text;
  for (const auto& item : value)
  {
    if (!value.IsSequence() || !item.IsScalar())
    {
      fields.fail(name, "a single value or a list");
    }
    text.append(text.empty() ? "" : ",").append(item.Scalar());
  }
  return text;
}

std::string knownNames(const PipelineOptions& options)
{
  std::string names;
  for (const NamedOption& option : listOptions(options))
  {
    names.append(names.empty() ? "" : ", ").append(option.name);
  }
  return names;
}

}  // namespace

std::vector<NamedOption> listOptions(const PipelineOptions& options)
{
  std::vector<NamedOption> list;
  visitOptions(options,
               [&](const char* name, const auto& field) {
                 list.push_back({name, toOptionValue(field)});
               });
  return list;
}

std::string toString(const OptionValue& value)
{
  return std::visit(
      [](const auto& held) -> std::string
      {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, bool>)
        {
          return held ? "true" : "false";
        }
        else if constexpr (std::is_same_v<Held, std::string>)
        {
          return held;
        }
        else
        {
          return shortestText(held);
        }
      },
      value);
}

void setOption(PipelineOptions& options, const std::string& name, const std::string& text)
{
  bool found = false;
  visitOptions(options,
               [&](const char* field_name, auto& field)
               {
                 if (name == field_name)
                 {
                   parseInto(name, text, field);
                   found = true;
                 }
               });
  if (!found)
  {
    throw InputError("There is no setting '" + name + "'; the settings are " + knownNames(options) + ".");
  }
}

void setOption(PipelineOptions& options, const std::string& assignment)
{
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
  {
    throw InputError("A setting is given as NAME=VALUE, but this one is '" + assignment + "'.");
  }
  setOption(options, assignment.substr(0, equals), assignment.substr(equals + 1));
}

void readOptionsFile(const std::filesystem::path& path, PipelineOptions& options)
{
  const YAML::Node top = loadYaml(path);
  const YamlFields fields(path, "", top);
  for (const auto& entry : top)
  {
    const auto name = entry.first.as<std::string>("");
    if (name == "disparity_range")
    {
      const auto range = fields.numberPair(name, "[smallest, largest] disparity in pixels");
      options.disparity_range =
          DisparityRange{static_cast<float>(range->first), static_cast<float>(range->second)};
      continue;
    }
    try
    {
      setOption(options, name, settingText(fields, name));
    }
    catch (const InputError& error)
    {
      throw InputError("In '" + path.string() + "': " + error.what());
    }
  }
}

}  // namespace light_field_depth
