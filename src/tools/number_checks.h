#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_NUMBER_CHECKS_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_NUMBER_CHECKS_H

#include <cmath>
#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>

namespace light_field_depth
{
/// Checks of options that take numbers: those of CLI11 let "nan" pass, and write infinity in all its digits.
inline const CLI::Validator FINITE(
    [](std::string& text)
    {
      return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string()
                                                               : "'" + text + "' is not a finite number";
    },
    "");
inline const CLI::Validator POSITIVE(
    [](std::string& text)
    {
      const double value = std::strtod(text.c_str(), nullptr);
      return std::isfinite(value) && value > 0.0 ? std::string()
                                                 : "'" + text + "' is not a finite number above 0";
    },
    "");

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_NUMBER_CHECKS_H
